// fork, waitpid, pipes and sockets; PR_SET_PDEATHSIG is Linux's.
#include "mysim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
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

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

CannotStart::CannotStart(const std::string& program, const std::string& why)
    : std::runtime_error("cannot start " + program + ": " + why), reason(why) {}

namespace {

constexpr size_t kept_bytes = 65536;  // of a program that is not trusted

/// The two ends of a pipe, closed however the scope is left and never handed on to other programs.
struct Pipe {
  int read_end = -1, write_end = -1;  // -1: closed
  /// Throws std::runtime_error with the system's reason.
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    read_end = ends[0], write_end = ends[1];
  }
  ~Pipe() { close_end(read_end), close_end(write_end); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
};

/// What becomes stdin, stdout and stderr of a program; -1: /dev/null.
using StandardFiles = std::array<int, 3>;

bool set_standard_files(const StandardFiles& files) {
  for (int number = 0; number < 3; ++number) {
    const int file = files[number] >= 0 ? files[number] : open("/dev/null", O_RDWR | O_CLOEXEC);
    if ((file == number ? fcntl(file, F_SETFD, 0) : dup2(file, number)) < 0) return false;
  }
  return true;
}

/// Starts argv[0]; one that is not trusted in a process group of its own, that does not outlive this thread.
pid_t start(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
            const std::vector<std::string>& extra_env, const StandardFiles& files, bool trusted) {
  const std::vector<std::string> entries = program_environment(extra_env);
  const std::vector<char*> words = c_strings(argv), environment = c_strings(entries);
  const auto exec = argv[0].find('/') == std::string::npos ? execvpe : execve;
  Pipe exec_error;
  const pid_t parent = getpid(), child = fork();
  if (child == 0) {  // from here on only what is allowed between fork and exec
    if (!trusted) {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(127);
      signal(SIGPIPE, SIG_DFL);
    }
    if (chdir(cwd.c_str()) == 0 && set_standard_files(files)) exec(words[0], words.data(), environment.data());
    const int error = errno;
    [[maybe_unused]] const ssize_t told = write(exec_error.write_end, &error, sizeof error);
    _exit(127);
  }
  if (child < 0) throw CannotStart(argv[0], std::strerror(errno));
  Pipe::close_end(exec_error.write_end);
  int error = 0;
  ssize_t bytes;
  while ((bytes = read(exec_error.read_end, &error, sizeof error)) < 0 && errno == EINTR) continue;
  if (bytes != sizeof error) return child;
  waitpid(child, nullptr, 0);
  throw CannotStart(argv[0], std::strerror(error));
}

void wait_for(pid_t child, ProgramResult& result) {
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) continue;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.status = result.signal != 0 ? 128 + result.signal : WEXITSTATUS(status);
  result.cpu_seconds = cpu_seconds(usage);
}

/// The child stays a zombie, so that its number still names its group.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child;
}

void keep_last(std::string& text, size_t most) {
  if (text.size() > most) text.erase(0, text.size() - most);
}

/// Takes what is there without waiting; closes at the end of the stream.
void drain(Pipe& pipe, std::string& text, bool whole) {
  std::array<char, 4096> chunk;
  while (pipe.read_end >= 0) {
    const ssize_t n = read(pipe.read_end, chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    if (n <= 0) return Pipe::close_end(pipe.read_end);
    text.append(chunk.data(), static_cast<size_t>(n));
    if (!whole && text.size() > 2 * kept_bytes) keep_last(text, kept_bytes);
  }
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env, std::optional<double> timeout) {
  if (argv.empty()) throw std::runtime_error("run_program: no program named");
  const bool trusted = !timeout;
  Pipe out, err;
  const pid_t child = start(argv, cwd, extra_env, {-1, out.write_end, err.write_end}, trusted);
  for (Pipe* pipe : {&out, &err}) {
    Pipe::close_end(pipe->write_end);
    fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);
  }
  using Clock = std::chrono::steady_clock;
  ProgramResult result;
  const auto drain_both = [&] { drain(out, result.out, trusted), drain(err, result.err, trusted); };
  const Clock::time_point limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout.value_or(0)));
  Clock::time_point grace_end{};  // how long a child of the ended program may take to close its output
  for (int pause = 1;; pause = std::min(20, pause + 1)) {
    const bool ended = !trusted && has_ended(child);
    drain_both();
    const bool closed = out.read_end < 0 && err.read_end < 0;
    if (closed && (trusted || ended)) break;
    const Clock::time_point now = Clock::now();
    if (ended) {
      if (grace_end == Clock::time_point{}) grace_end = now + std::chrono::milliseconds(200);
      if ((result.left_children = now >= grace_end)) break;
    } else if ((result.timed_out = !trusted && now >= limit)) {
      break;
    }
    pollfd wait[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 2, trusted ? -1 : pause);  // ms; the end of a program that closed its output is seen by looking again
  }
  if (!trusted) kill(-child, SIGKILL);
  wait_for(child, result);
  drain_both();
  if (!trusted) keep_last(result.out, kept_bytes), keep_last(result.err, kept_bytes);
  return result;
}

int run_in_terminal(const std::vector<std::string>& argv) {
  ProgramResult result;
  wait_for(start(argv, ".", {}, {0, 1, 2}, true), result);
  return result.status;
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
  try {
    child_ = start(argv, ".", {}, {ends[1], -1, err_}, true);
  } catch (...) {
    for (const int file : {ends[0], ends[1], err_}) close(file);
    throw;
  }
  close(ends[1]);
  input_ = ends[0];
}

ProcessWithInput::~ProcessWithInput() {
  if (input_ >= 0) close(input_);
  if (child_ > 0) kill(child_, SIGKILL), waitpid(child_, nullptr, 0);
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
  wait_for(child_, result), child_ = 0;
  lseek(err_, 0, SEEK_SET);
  std::array<char, 4096> chunk;
  for (ssize_t n; (n = read(err_, chunk.data(), chunk.size())) > 0;)
    result.err.append(chunk.data(), static_cast<size_t>(n));
  return result;
}

}  // namespace crosscheck
