// Runs another program by posix_spawn: stdin from /dev/null, stdout and stderr read through two pipes.
#include "report/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "reference/protocol/pipe.h"
#include "report/spawn.h"

namespace crosscheck {
namespace {

/// Reads both pipes until both are at their end: reading one after the other could block the program for ever.
void read_all(Pipe& out, std::string& out_text, Pipe& err, std::string& err_text) {
  std::array<char, 4096> chunk;
  while (out.read_end >= 0 || err.read_end >= 0) {
    pollfd wait[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    if (poll(wait, 2, -1) < 0) {
      if (errno == EINTR) continue;
      throw std::runtime_error(std::string("poll: ") + std::strerror(errno));
    }
    for (int i = 0; i < 2; ++i) {
      if (wait[i].fd < 0 || wait[i].revents == 0) continue;
      Pipe& from = i == 0 ? out : err;
      const ssize_t n = read(from.read_end, chunk.data(), chunk.size());
      if (n > 0) (i == 0 ? out_text : err_text).append(chunk.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) Pipe::close_end(from.read_end);
    }
  }
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env) {
  if (argv.empty()) throw std::runtime_error("run_program: no program named");
  Pipe out, err;
  FileActions actions;
  posix_spawn_file_actions_addopen(&actions.list, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.list, out.write_end, 1);
  posix_spawn_file_actions_adddup2(&actions.list, err.write_end, 2);
  posix_spawn_file_actions_addchdir_np(&actions.list, cwd.c_str());

  const pid_t child = spawn(argv, actions, extra_env);
  Pipe::close_end(out.write_end), Pipe::close_end(err.write_end);

  ProgramResult result;
  read_all(out, result.out, err, result.err);
  result.status = end_of(child);
  return result;
}

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (size_t begin = 0; begin <= folders.size();) {
    const size_t end = std::min(folders.find(':', begin), folders.size());
    if (std::filesystem::exists(std::filesystem::path(folders.substr(begin, end - begin)) / program)) return true;
    begin = end + 1;
  }
  return false;
}

std::string last_lines(const std::string& text, int count) {
  size_t at = text.find_last_not_of('\n');
  for (; at != std::string::npos && count > 0; --count) at = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return text.substr(at == std::string::npos ? 0 : at + 1);
}

}  // namespace crosscheck
