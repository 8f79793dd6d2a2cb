#include "tests/coursework/grader/container.h"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "mysim/base/process.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// Forbids new namespaces. Called between fork and exec. Returns false on any failure.
bool close_namespaces() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  if (!filter) return false;
  int wrong = 0;
  for (const int call : {SCMP_SYS(unshare), SCMP_SYS(setns)})
    wrong |= seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), call, 0);
  for (const unsigned long space : {CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWPID, CLONE_NEWNET, CLONE_NEWIPC, CLONE_NEWUTS})
    wrong |= seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
                              scmp_arg_cmp{0, SCMP_CMP_MASKED_EQ, space, space});
  wrong |= seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  return !wrong && seccomp_load(filter) == 0;
}

[[noreturn]] void exec_on_one_cpu(char* const* command, char* const* environment, int log, bool closed) {
  cpu_set_t allowed, one;
  CPU_ZERO(&one);
  sched_getaffinity(0, sizeof allowed, &allowed);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &allowed)) CPU_SET(cpu, &one);
  sched_setaffinity(0, sizeof one, &one);
  dup2(open("/dev/null", O_RDONLY), 0);
  dup2(log, 1), dup2(log, 2);
  if (!closed || close_namespaces()) execve(command[0], command, environment);
  _exit(127);
}

/// All processes that descend from this one, parents first.
std::vector<pid_t> descendants() {
  std::multimap<pid_t, pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::string stat;
    std::getline(std::ifstream(entry.path() / "stat"), stat);
    // the fields after the command's name, which may contain any character, including a parenthesis
    std::istringstream rest(stat.substr(std::min(stat.size(), stat.rfind(')') + 1)));
    char state = 0;
    pid_t parent = 0;
    if (rest >> state >> parent) children.emplace(parent, std::stoi(name));
  }
  std::vector<pid_t> found = {getpid()};
  for (size_t i = 0; i < found.size(); ++i)
    for (auto [at, end] = children.equal_range(found[i]); at != end; ++at) found.push_back(at->second);
  found.erase(found.begin());
  return found;
}

/// Resident memory (MB); 0 for a process that has ended.
long resident(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/smaps_rollup");
  for (std::string word; in >> word;)
    if (long kilobytes = 0; word == "Pss:" && in >> kilobytes) return kilobytes / 1024;
  return 0;
}

}  // namespace

Usage run_in_container(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                       const fs::path& log, const Container& container) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) throw std::runtime_error(log.string() + ": cannot be written");
  // adopts orphaned descendants, so that these are measured too, and killed at the end
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const auto words = crosscheck::c_strings(command), named = crosscheck::c_strings(environment);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t first = fork();
  if (first == 0) exec_on_one_cpu(words.data(), named.data(), file, container.closed);
  close(file);
  if (first < 0) throw std::runtime_error("no process can be started");

  Usage used;
  double cpu = 0;
  for (bool running = true; running;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::vector<pid_t> all = descendants();
    long memory = 0;
    for (const pid_t process : all) memory += resident(process);
    used.memory = std::max(used.memory, memory);
    used.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    used.too_large = used.too_large || memory > container.memory;
    used.too_late = used.too_late || used.time > container.time;
    if (used.too_large || used.too_late)
      for (const pid_t process : all) kill(process, SIGKILL);
    int status = 0;
    rusage taken{};
    for (pid_t ended; (ended = wait4(-1, &status, WNOHANG, &taken)) > 0;) {
      cpu += crosscheck::cpu_seconds(taken);
      if (ended != first) continue;
      running = false;
      used.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }
  }
  for (std::vector<pid_t> left; !(left = descendants()).empty();) {
    for (const pid_t process : left) kill(process, SIGKILL);
    while (wait4(-1, nullptr, WNOHANG, nullptr) > 0) continue;
  }
  used.time = std::max(used.time, cpu / container.cpus);
  used.too_late = used.too_late || used.time > container.time;
  return used;
}

}  // namespace coursework
