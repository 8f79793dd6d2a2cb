// fork, posix_spawn, waitpid, pipes and sockets; PR_SET_PDEATHSIG is Linux's.
#include "mysim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace crosscheck {
namespace {

std::string_view name_of_entry(std::string_view entry) { return entry.substr(0, entry.find('=')); }

bool names_a_locale(std::string_view name) { return name == "LANG" || name == "LANGUAGE" || name.starts_with("LC_"); }

}  // namespace

std::vector<std::string> program_environment(const std::vector<std::string>& extra) {
  std::vector<std::string> all = extra;
  const auto given = [&](std::string_view name) {
    return std::ranges::any_of(all, [&](const std::string& entry) { return name_of_entry(entry) == name; });
  };
  for (const char* own : {"LC_ALL=C.UTF-8", "TZ=UTC"})
    if (!given(name_of_entry(own))) all.emplace_back(own);
  for (char** entry = environ; *entry; ++entry)
    if (const std::string_view name = name_of_entry(*entry); !names_a_locale(name) && !given(name))
      all.emplace_back(*entry);
  return all;
}

std::vector<char*> c_strings(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

namespace {

using Clock = std::chrono::steady_clock;
constexpr size_t kept_bytes = 65536;

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
    if (text.size() > 2 * kept_bytes) text.erase(0, text.size() - kept_bytes);
  }
}

/// In the child; only what is allowed between fork and exec. An error goes back as its number.
[[noreturn]] void exec_child(char* const* argv, char* const* environment, pid_t parent, int in, const Pipe& out,
                             const Pipe& err, const Pipe& exec_error) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  signal(SIGPIPE, SIG_DFL);
  if (dup2(in, 0) >= 0 && dup2(out.write_end, 1) >= 0 && dup2(err.write_end, 2) >= 0)
    execve(argv[0], argv, environment);
  const int error = errno;
  [[maybe_unused]] const ssize_t told = write(exec_error.write_end, &error, sizeof error);
  _exit(127);
}

/// Kills the group and takes the dead leader away, however the scope is left.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() { kill_and_reap(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The leader stays a zombie, so that its number still names the group.
  bool ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
  }
  void kill_and_reap() {
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

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

}  // namespace

ProcessResult run_process(const std::vector<std::string>& words, double timeout) {
  const std::vector<std::string> entries = program_environment();
  const std::vector<char*> argv = c_strings(words), environment = c_strings(entries);
  Pipe out, err, exec_error;
  int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (in < 0) fail("/dev/null", errno);
  const pid_t parent = getpid(), pid = fork();
  const int fork_error = errno;
  if (pid == 0) exec_child(argv.data(), environment.data(), parent, in, out, err, exec_error);
  Pipe::close_end(in);
  if (pid < 0) fail(words[0] + " cannot be started", fork_error);
  Child child(pid);
  Pipe::close_end(out.write_end), Pipe::close_end(err.write_end), Pipe::close_end(exec_error.write_end);
  int error = 0;
  if (read(exec_error.read_end, &error, sizeof error) == sizeof error) fail(words[0] + " cannot be started", error);
  for (const Pipe* pipe : {&out, &err}) fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);

  ProcessResult end;
  const Clock::time_point limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  Clock::time_point grace_end{};  // how long a child of the ended program may take to close its output
  for (int pause = 1;; pause = std::min(20, pause + 1)) {
    const bool ended = child.ended();
    drain(out, end.out), drain(err, end.err);
    const Clock::time_point now = Clock::now();
    if (ended) {
      if (out.read_end < 0 && err.read_end < 0) break;
      if (grace_end == Clock::time_point{}) grace_end = now + std::chrono::milliseconds(200);
      if ((end.left_children = now >= grace_end)) break;
    } else if ((end.timed_out = now >= limit)) {
      break;
    }
    pollfd wait[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 2, pause);  // ms; the end of a program that closed its output is seen by looking again
  }
  child.kill_and_reap();
  drain(out, end.out), drain(err, end.err);
  for (std::string* text : {&end.out, &end.err})
    if (text->size() > kept_bytes) text->erase(0, text->size() - kept_bytes);
  end.cpu_seconds = seconds(child.usage.ru_utime) + seconds(child.usage.ru_stime);
  if (WIFSIGNALED(child.status)) end.signal = WTERMSIG(child.status);
  if (WIFEXITED(child.status)) end.status = WEXITSTATUS(child.status);
  return end;
}

pid_t spawn(const std::vector<std::string>& argv, const FileActions& actions,
            const std::vector<std::string>& extra_env) {
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0].c_str(), &actions.list, nullptr, c_strings(argv).data(),
                                  c_strings(program_environment(extra_env)).data());
  if (failed) throw std::runtime_error("cannot start " + argv[0] + ": " + std::strerror(failed));
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

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
  result.status = wait_for(child);
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

// stdin is a socket, as writing to the pipe of a program that has ended would end this one; stderr is a nameless file
// in memory, so that no reader is needed.

ProcessWithInput::ProcessWithInput(const std::vector<std::string>& argv) {
  int ends[2] = {-1, -1};
  err_ = memfd_create("stderr", MFD_CLOEXEC);
  if (err_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    const std::string why = std::strerror(errno);
    if (err_ >= 0) close(err_);
    throw std::runtime_error("cannot feed " + argv[0] + ": " + why);
  }
  FileActions actions;
  posix_spawn_file_actions_adddup2(&actions.list, ends[1], 0);
  posix_spawn_file_actions_addopen(&actions.list, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.list, err_, 2);
  try {
    child_ = spawn(argv, actions);
  } catch (...) {
    for (const int file : {ends[0], ends[1], err_}) close(file);
    throw;
  }
  close(ends[1]);
  input_ = ends[0];
}

ProcessWithInput::~ProcessWithInput() {
  if (input_ >= 0) close(input_);
  if (child_ > 0) kill(child_, SIGKILL), wait_for(child_);
  close(err_);
}

bool ProcessWithInput::write_input(const void* data, size_t bytes) {
  for (const char* at = static_cast<const char*>(data); bytes > 0;) {
    const ssize_t sent = send(input_, at, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    at += sent, bytes -= static_cast<size_t>(sent);
  }
  return true;
}

ProgramResult ProcessWithInput::finish() {
  close(input_), input_ = -1;
  ProgramResult result;
  result.status = wait_for(child_), child_ = 0;
  lseek(err_, 0, SEEK_SET);
  std::array<char, 4096> chunk;
  for (ssize_t n; (n = read(err_, chunk.data(), chunk.size())) > 0;)
    result.err.append(chunk.data(), static_cast<size_t>(n));
  return result;
}

}  // namespace crosscheck
