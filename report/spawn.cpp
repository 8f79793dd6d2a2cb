// posix_spawn and waitpid.
#include "report/spawn.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "mysim/program_environment.h"

namespace crosscheck {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> list;
  for (const std::string& s : strings) list.push_back(const_cast<char*>(s.c_str()));
  list.push_back(nullptr);
  return list;
}

}  // namespace

pid_t spawn(const std::vector<std::string>& argv, const FileActions& actions,
            const std::vector<std::string>& extra_env) {
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0].c_str(), &actions.list, nullptr, pointers(argv).data(),
                                  pointers(program_environment(extra_env)).data());
  if (failed) throw std::runtime_error("cannot start " + argv[0] + ": " + std::strerror(failed));
  return child;
}

int end_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace crosscheck
