// fork and exec, by POSIX; PR_SET_PDEATHSIG is Linux's.
#include "reference/protocol/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "mysim/program_environment.h"
#include "reference/protocol/pipe.h"

namespace crosscheck {
namespace {

using Clock = std::chrono::steady_clock;
constexpr size_t kept = 65536;

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::strerror(error));
}

/// Takes what is there without waiting; closes at the end of the stream.
void drain(Pipe& pipe, std::string& text) {
  std::array<char, 4096> chunk;
  while (pipe.read_end >= 0) {
    const ssize_t n = read(pipe.read_end, chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    if (n <= 0) return Pipe::close_end(pipe.read_end);
    text.append(chunk.data(), static_cast<size_t>(n));
    if (text.size() > 2 * kept) text.erase(0, text.size() - kept);
  }
}

/// In the child; only what is allowed between fork and exec. An error goes back as its number.
[[noreturn]] void become(char* const* argv, char* const* environment, pid_t parent, int in, const Pipe& out,
                         const Pipe& err, const Pipe& trouble) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  signal(SIGPIPE, SIG_DFL);
  if (dup2(in, 0) >= 0 && dup2(out.write_end, 1) >= 0 && dup2(err.write_end, 2) >= 0)
    execve(argv[0], argv, environment);
  const int error = errno;
  [[maybe_unused]] const ssize_t told = write(trouble.write_end, &error, sizeof error);
  _exit(127);
}

/// Kills the group and takes the dead leader away, however the scope is left.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() { bury(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The leader stays a zombie, so that its number still names the group.
  bool ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
  }
  void bury() {
    if (pid_ <= 0) return;
    kill(-pid_, SIGKILL);
    kill(pid_, SIGKILL);  // should it not have come to setpgid yet
    while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    pid_ = 0;
  }
  int status = 0;
  rusage usage{};

 private:
  pid_t pid_;
};

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& words, double timeout) {
  const std::vector<std::string> entries = program_environment();
  const std::vector<char*> argv = pointers(words), environment = pointers(entries);
  Pipe out, err, trouble;
  int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (in < 0) fail("/dev/null", errno);
  const pid_t parent = getpid(), pid = fork();
  const int fork_error = errno;
  if (pid == 0) become(argv.data(), environment.data(), parent, in, out, err, trouble);
  Pipe::close_end(in);
  if (pid < 0) fail(words[0] + " cannot be started", fork_error);
  Child child(pid);
  Pipe::close_end(out.write_end), Pipe::close_end(err.write_end), Pipe::close_end(trouble.write_end);
  int error = 0;
  if (read(trouble.read_end, &error, sizeof error) == sizeof error) fail(words[0] + " cannot be started", error);
  for (const Pipe* pipe : {&out, &err}) fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);

  ProcessEnd end;
  const Clock::time_point limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  Clock::time_point patience{};  // how long a child of the ended program may take to close its output
  for (int pause = 1;; pause = std::min(20, pause + 1)) {
    const bool ended = child.ended();
    drain(out, end.out), drain(err, end.err);
    const Clock::time_point now = Clock::now();
    if (ended) {
      if (out.read_end < 0 && err.read_end < 0) break;
      if (patience == Clock::time_point{}) patience = now + std::chrono::milliseconds(200);
      if ((end.left_children = now >= patience)) break;
    } else if ((end.timed_out = now >= limit)) {
      break;
    }
    pollfd wait[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 2, pause);  // ms; the end of a program that closed its output is seen by looking again
  }
  child.bury();
  drain(out, end.out), drain(err, end.err);
  for (std::string* text : {&end.out, &end.err})
    if (text->size() > kept) text->erase(0, text->size() - kept);
  end.cpu_seconds = seconds(child.usage.ru_utime) + seconds(child.usage.ru_stime);
  if (WIFSIGNALED(child.status)) end.signal = WTERMSIG(child.status);
  if (WIFEXITED(child.status)) end.status = WEXITSTATUS(child.status);
  return end;
}

}  // namespace crosscheck
