// Linux only: namespaces, PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER.
#include "mysim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>

#include "mysim/base/files.h"
#include "mysim/base/text.h"

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

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr size_t kept_bytes = 65536;  // per output stream of an untrusted program

}  // namespace

namespace process_detail {

/// A pipe, closed at the end of the scope and not inherited by other programs.
struct Pipe {
  int read_end = -1, write_end = -1;  // -1: closed
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

}  // namespace process_detail

namespace {

using process_detail::Pipe;

/// Files for stdin, stdout and stderr of a program; -1 stands for /dev/null.
using StandardFiles = std::array<int, 3>;

bool set_standard_files(const StandardFiles& files) {
  for (int number = 0; number < 3; ++number) {
    const int file = files[number] >= 0 ? files[number] : open("/dev/null", O_RDWR | O_CLOEXEC);
    if ((file == number ? fcntl(file, F_SETFD, 0) : dup2(file, number)) < 0) return false;
  }
  return true;
}

/// Ends this process after a failed system call; the parent reads `error`.
[[noreturn]] void fail_start(int error_file, int error) {
  [[maybe_unused]] const ssize_t written = write(error_file, &error, sizeof error);
  _exit(127);
}

/// Arguments of exec*(), built before the fork because the child must not allocate.
struct Call {
  std::vector<std::string> entries;
  std::vector<char*> words, environment;
  std::string cwd;
  StandardFiles files;
  bool in_path;

  Call(const std::vector<std::string>& argv, const std::filesystem::path& folder,
       const std::vector<std::string>& extra_env, const StandardFiles& standard_files)
      : entries(program_environment(extra_env)),
        words(c_strings(argv)),
        environment(c_strings(entries)),
        cwd(folder.string()),
        files(standard_files),
        in_path(argv[0].find('/') == std::string::npos) {
    std::string first;
    if (!in_path && std::getline(std::ifstream(folder / argv[0]), first) && first.starts_with("#!") &&
        first.ends_with('\r'))
      throw CannotStart(argv[0], "its first line ends with a carriage return (CRLF); expected Unix line ends");
  }

  [[noreturn]] void become(int error_file) const {
    if (chdir(cwd.c_str()) == 0 && set_standard_files(files))
      (in_path ? execvpe : execve)(words[0], words.data(), environment.data());
    fail_start(error_file, errno);
  }
};

/// fork() without the C library's handlers, whose locks other threads may hold. The child may call only what is
/// permitted between fork and exec.
pid_t clone_process(unsigned long flags) {
  return static_cast<pid_t>(syscall(SYS_clone, flags | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

struct Started {
  pid_t child;
  int error;  // 0: it is running
};

/// Starts a process in which `work` executes a program, or writes an error number to the given file and ends.
template <class Work>
Started start_process(unsigned long flags, const Work& work) {
  Pipe exec_error;
  const pid_t child = clone_process(flags);
  if (child == 0) work(exec_error.write_end);
  if (child < 0) return {child, errno};
  Pipe::close_end(exec_error.write_end);
  int error = 0;
  ssize_t bytes;
  while ((bytes = read(exec_error.read_end, &error, sizeof error)) < 0 && errno == EINTR) continue;
  if (bytes != sizeof error) return {child, 0};
  waitpid(child, nullptr, 0);
  return {child, error};
}

pid_t start(const Call& call) {
  const auto [child, error] = start_process(0, [&](int error_file) { call.become(error_file); });
  if (error != 0) throw CannotStart(call.words[0], std::strerror(error));
  return child;
}

// An untrusted program may detach itself (setsid, a double fork), leave children behind and kill its parent. It is
// therefore started by a watcher, a process that only waits for the program and ends all its descendants. If the kernel
// permits, the watcher is the first process of a pid namespace: nothing inside can kill it or escape, and the kernel
// ends all processes inside with it. Otherwise the watcher is a subreaper: it adopts orphans, and kills its children
// until it has none. A program that kills such a watcher escapes, and the result says so.

struct WatcherReport {
  int status;  // as of wait()
  rusage usage;
  bool timed_out, left_children;
};

bool write_small_file(const char* path, const char* text) {
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const ssize_t size = static_cast<ssize_t>(std::strlen(text)), written = write(file, text, static_cast<size_t>(size));
  close(file);
  return written == size;
}

/// User and group maps that keep the process's ids in a new user namespace.
struct UserMaps {
  std::string user, group;
  static std::string same(unsigned long number) { return std::to_string(number) + " " + std::to_string(number) + " 1"; }
  UserMaps() : user(same(geteuid())), group(same(getegid())) {}
  bool apply() const {
    return write_small_file("/proc/self/uid_map", user.c_str()) && write_small_file("/proc/self/setgroups", "deny") &&
           write_small_file("/proc/self/gid_map", group.c_str());
  }
};

/// Moves a file to descriptor 3 and closes all others except the standard ones.
void keep_as_number_3(int file) {
  dup2(file, 3);
  if (syscall(SYS_close_range, 4, ~0U, 0) == 0) return;
  for (int number = 4; number < std::min(sysconf(_SC_OPEN_MAX), 65536L); ++number) close(number);
}

constexpr milliseconds grace(200);     // time for the children of a terminated program to end as well
constexpr int try_without_users = -1;  // not an errno value: the user maps could not be written

/// The watcher's main loop. Reports when all processes have ended, at most ten seconds after the limit or SIGTERM.
[[noreturn]] void watch(const Call& call, unsigned long flags, const UserMaps& users, milliseconds limit,
                        int error_file, int report) {
  setpgid(0, 0);  // out of reach of terminal signals to the parent's process group
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd parent{error_file, 0, 0};
  if (poll(&parent, 1, 0) > 0) _exit(127);  // the parent has already ended
  if ((flags & CLONE_NEWUSER) && !users.apply()) fail_start(error_file, try_without_users);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  signal(SIGCHLD, SIG_DFL);
  sigset_t child_ended, before;
  sigemptyset(&child_ended);
  sigaddset(&child_ended, SIGCHLD);
  sigaddset(&child_ended, SIGTERM);  // if blocked, stays pending even in the first process of a namespace
  sigprocmask(SIG_BLOCK, &child_ended, &before);
  const pid_t program = clone_process(0);
  if (program == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    signal(SIGPIPE, SIG_DFL);
    call.become(error_file);
  }
  if (program < 0) fail_start(error_file, errno);
  keep_as_number_3(report);
  WatcherReport told{};
  bool ended = false;
  for (Clock::time_point until = Clock::now() + limit;;) {
    int status = 0;
    rusage usage{};
    const pid_t one = wait4(-1, &status, WNOHANG, &usage);
    if (one == program) {
      told.status = status, told.usage = usage, ended = true;
      until = Clock::now() + (told.timed_out ? milliseconds(0) : grace);
    }
    if (one > 0) continue;
    told.left_children = ended && one == 0;
    const auto left = std::clamp<milliseconds>(std::chrono::ceil<milliseconds>(until - Clock::now()), milliseconds(0),
                                               std::chrono::seconds(1000));
    if (ended && (one < 0 || left.count() == 0)) break;
    if (left.count() == 0) {
      told.timed_out = true;
      kill(program, SIGKILL);
      until = Clock::time_point::max();
    }
    const timespec rest{left.count() / 1000, left.count() % 1000 * 1000000};
    if (sigtimedwait(&child_ended, nullptr, &rest) == SIGTERM && !told.timed_out) until = Clock::now();
  }
  if (!(flags & CLONE_NEWPID)) end_children(milliseconds(0));
  [[maybe_unused]] const ssize_t size = write(3, &told, sizeof told);
  _exit(0);
}

/// Starts a watcher, which starts the program; returns the watcher.
pid_t start_watched(const Call& call, milliseconds limit, int report) {
  const UserMaps users;
  int last_error = 0;
  for (const unsigned long flags : {CLONE_NEWPID, CLONE_NEWUSER | CLONE_NEWPID, 0}) {
    const auto [watcher, error] =
        start_process(flags, [&](int error_file) { watch(call, flags, users, limit, error_file, report); });
    if (error == 0) return watcher;
    last_error = error;
    if (watcher >= 0 && error != try_without_users) break;
  }
  throw CannotStart(call.words[0], std::strerror(last_error));
}

void set_end(int status, const rusage& usage, ProgramResult& result) {
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.status = result.signal != 0 ? 128 + result.signal : WEXITSTATUS(status);
  result.cpu_seconds = cpu_seconds(usage);
}

void wait_for(pid_t child, ProgramResult& result) {
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) continue;
  set_end(status, usage, result);
}

/// Appends what is available without waiting, and closes the pipe at end of stream. Keeps only the last `most` bytes.
void drain(Pipe& pipe, std::string& text, size_t most) {
  std::array<char, 4096> chunk;
  while (pipe.read_end >= 0) {
    const ssize_t n = read(pipe.read_end, chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) break;
    if (n <= 0) Pipe::close_end(pipe.read_end);
    if (n > 0) text.append(chunk.data(), static_cast<size_t>(n));
    if (text.size() / 2 > most) text.erase(0, text.size() - most);
  }
  if (text.size() > most) text.erase(0, text.size() - most);
}

}  // namespace

void end_children(milliseconds grace_period) {
  bool asked = false;
  for (const auto begin = Clock::now();; usleep(1000)) {
    pid_t ended;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) continue;
    const auto waited = Clock::now() - begin;
    if (ended < 0 || waited > grace_period + std::chrono::seconds(10)) return;
    if (asked && waited < grace_period) continue;
    char text[4096];
    const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text);
    if (file >= 0) close(file);
    pid_t child = 0;
    for (ssize_t i = 0; i < size; ++i) {  // a number without a blank after it is truncated
      if (text[i] >= '0' && text[i] <= '9') {
        child = 10 * child + (text[i] - '0');
      } else {
        if (child > 0) kill(child, waited < grace_period ? SIGTERM : SIGKILL);
        child = 0;
      }
    }
    asked = true;
  }
}

ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env, std::optional<double> timeout) {
  if (argv.empty()) throw std::runtime_error("run_program: no program named");
  Pipe out, err, report;
  const Call call(argv, cwd, extra_env, {-1, out.write_end, err.write_end});
  const milliseconds limit(static_cast<long>(1000 * std::min(timeout.value_or(0), 1e9)));
  const pid_t child = timeout ? start_watched(call, limit, report.write_end) : start(call);
  for (Pipe* pipe : {&out, &err, &report}) {
    Pipe::close_end(pipe->write_end);
    fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);
  }
  const size_t most = timeout ? kept_bytes : std::string::npos;
  const auto give_up = Clock::now() + limit + std::chrono::seconds(12);  // a watcher that was stopped never reports
  ProgramResult result;
  for (;;) {
    drain(out, result.out, most), drain(err, result.err, most);
    if (!timeout && out.read_end < 0 && err.read_end < 0) break;
    pollfd wait[3] = {
        {timeout ? report.read_end : -1, POLLIN, 0}, {out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 3, timeout ? 1000 : -1);
    if (wait[0].revents != 0) break;
    if (timeout && Clock::now() > give_up) kill(child, SIGKILL);
  }
  wait_for(child, result);
  if (!timeout) return result;
  remove_stale_temporary_folders();  // left by the killed processes
  WatcherReport told{};
  result.killed_watcher = read(report.read_end, &told, sizeof told) != sizeof told;
  if (!result.killed_watcher) {
    set_end(told.status, told.usage, result);
    result.timed_out = told.timed_out, result.left_children = told.left_children;
  }
  drain(out, result.out, most), drain(err, result.err, most);
  return result;
}

struct LineServer::Process {
  Pipe in, out, err, report;
  pid_t parent = getpid(), watcher = -1;
  std::optional<clockid_t> clock;  // CPU time of the program
  std::string unread;              // stdout received so far

  double cpu_time() const {
    timespec now{};
    if (!clock || clock_gettime(*clock, &now) != 0) return 0;
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
};

LineServer::LineServer(const std::vector<std::string>& argv, const std::filesystem::path& cwd)
    : process_(std::make_unique<Process>()) {
  Process& p = *process_;
  const Call call(argv, cwd, {}, {p.in.read_end, p.out.write_end, p.err.write_end});
  p.watcher = start_watched(call, std::chrono::years(10), p.report.write_end);
  Pipe::close_end(p.in.read_end);
  for (Pipe* pipe : {&p.out, &p.err, &p.report}) {
    Pipe::close_end(pipe->write_end);
    fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);
  }
  fcntl(p.in.write_end, F_SETFL, O_NONBLOCK);
  pid_t program = 0;  // the watcher's only child
  std::ifstream("/proc/" + std::to_string(p.watcher) + "/task/" + std::to_string(p.watcher) + "/children") >> program;
  if (clockid_t clock; program > 0 && clock_getcpuclockid(program, &clock) == 0) p.clock = clock;
}

LineServer::~LineServer() {
  Process& p = *process_;
  if (!is_mine()) return;
  Pipe::close_end(p.in.write_end);
  pollfd ended{p.report.read_end, POLLIN, 0};
  if (poll(&ended, 1, static_cast<int>(grace.count())) == 0) kill(p.watcher, SIGTERM);
  if (poll(&ended, 1, 12'000) == 0) kill(p.watcher, SIGKILL);
  ProgramResult unused;
  wait_for(p.watcher, unused);
  remove_stale_temporary_folders();
}

bool LineServer::is_mine() const { return process_->parent == getpid(); }

LineServer::Answer LineServer::ask(const std::string& line, double seconds) {
  Process& p = *process_;
  Answer answer;
  const double begin = p.cpu_time();
  const auto until = Clock::now() + milliseconds(static_cast<long>(1000 * std::min(seconds, 1e9)));
  std::string unsent = line + '\n';
  const auto send = [&] {  // writing to a program that has ended must not end this process by SIGPIPE
    sigset_t pipe_signal, before;
    sigemptyset(&pipe_signal), sigaddset(&pipe_signal, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
    const ssize_t sent = write(p.in.write_end, unsent.data(), unsent.size());
    const bool broken = sent < 0 && errno == EPIPE;
    if (sent > 0) unsent.erase(0, static_cast<size_t>(sent));
    if (const timespec now{}; broken) sigtimedwait(&pipe_signal, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return !broken;
  };
  for (;;) {
    if (!unsent.empty() && !send()) return answer;
    drain(p.out, p.unread, kept_bytes), drain(p.err, answer.err, kept_bytes);
    for (size_t end; (end = p.unread.find('\n')) != std::string::npos && answer.line.empty();) {
      if (p.unread[0] == '{') answer.line = p.unread.substr(0, end);
      p.unread.erase(0, end + 1);
    }
    answer.cpu_seconds = std::max(0., p.cpu_time() - begin);  // the program may have ended
    if (!answer.line.empty() || p.out.read_end < 0 || p.unread.size() == kept_bytes) return answer;
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now()).count();
    if (left <= 0) {
      answer.timed_out = true;
      return answer;
    }
    pollfd wait[4] = {{p.out.read_end, POLLIN, 0},
                      {p.err.read_end, POLLIN, 0},
                      {p.report.read_end, POLLIN, 0},
                      {unsent.empty() ? -1 : p.in.write_end, POLLOUT, 0}};
    poll(wait, 4, static_cast<int>(std::min(left, 1000L)));
    if (wait[2].revents != 0 && wait[0].revents == 0) return answer;
  }
}

int run_in_terminal(const std::vector<std::string>& argv) {
  ProgramResult result;
  wait_for(start(Call(argv, ".", {}, {0, 1, 2})), result);
  return result.status;
}

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  return std::ranges::any_of(split(path ? path : "", ':'), [&](const std::string& folder) {
    return std::filesystem::exists(std::filesystem::path(folder) / program);
  });
}

std::string last_lines(const std::string& text, int count) {
  size_t at = text.find_last_not_of('\n');
  for (; at != std::string::npos && count > 0; --count) at = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return text.substr(at == std::string::npos ? 0 : at + 1);
}

}  // namespace crosscheck
