// fork, waitpid, pipes and sockets; namespaces, PR_SET_PDEATHSIG and PR_SET_CHILD_SUBREAPER are Linux's.
#include "mysim/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
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
#include <stdexcept>
#include <string_view>

#include "mysim/base/files.h"

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

/// What exec and its kin take, made before the fork: nothing may be allocated behind it.
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

  /// Becomes the program; where that fails, the system's reason is written to the file.
  [[noreturn]] void become(int error_file) const {
    if (chdir(cwd.c_str()) == 0 && set_standard_files(files))
      (in_path ? execvpe : execve)(words[0], words.data(), environment.data());
    const int error = errno;
    [[maybe_unused]] const ssize_t told = write(error_file, &error, sizeof error);
    _exit(127);
  }
};

/// The number that was written into the pipe before its other end was closed; 0: none.
int number_from(Pipe& pipe) {
  Pipe::close_end(pipe.write_end);
  int number = 0;
  ssize_t bytes;
  while ((bytes = read(pipe.read_end, &number, sizeof number)) < 0 && errno == EINTR) continue;
  return bytes == sizeof number ? number : 0;
}

pid_t start(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
            const std::vector<std::string>& extra_env, const StandardFiles& files) {
  const Call call(argv, cwd, extra_env, files);
  Pipe exec_error;
  const pid_t child = fork();
  if (child == 0) call.become(exec_error.write_end);
  if (child < 0) throw CannotStart(argv[0], std::strerror(errno));
  const int error = number_from(exec_error);
  if (error == 0) return child;
  waitpid(child, nullptr, 0);
  throw CannotStart(argv[0], std::strerror(error));
}

// A program that is not trusted may detach itself (setsid, a double fork), leave children behind and kill its parent.
// It is started by a watcher, a process that does nothing else, waits for it and ends all that descends from it. Where
// the kernel allows it the watcher is the first process of a pid namespace of its own: nothing inside can kill it or
// get out, and the kernel ends all with it. Elsewhere it is a subreaper, to which orphans come, and kills its children
// until it has none; a program that kills it there is not contained, which is reported.

/// What a watcher tells of the program that it waited for.
struct WatcherReport {
  int status;  // as of wait()
  rusage usage;
  bool left_children;  // other processes of it had not ended by then
};

/// fork() without what the C library does about it, whose locks other threads may hold: the child calls only what is
/// allowed between fork and exec.
pid_t clone_process(unsigned long flags) {
  return static_cast<pid_t>(syscall(SYS_clone, flags | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

bool write_small_file(const char* path, const char* text) {
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const ssize_t size = static_cast<ssize_t>(std::strlen(text)), written = write(file, text, static_cast<size_t>(size));
  close(file);
  return written == size;
}

/// Texts by which a process in a user namespace of its own keeps the numbers of its user and group.
struct UserMaps {
  std::string user, group;
  static std::string same(unsigned long number) { return std::to_string(number) + " " + std::to_string(number) + " 1"; }
  UserMaps() : user(same(geteuid())), group(same(getegid())) {}
  bool apply() const {
    return write_small_file("/proc/self/uid_map", user.c_str()) && write_small_file("/proc/self/setgroups", "deny") &&
           write_small_file("/proc/self/gid_map", group.c_str());
  }
};

/// Closes all files of this process but the standard ones and two.
void close_all_but(int a, int b) {
  const unsigned low = static_cast<unsigned>(std::min(a, b)), high = static_cast<unsigned>(std::max(a, b));
  const unsigned ranges[3][2] = {{3, low - 1}, {low + 1, high - 1}, {high + 1, ~0U}};
  for (const auto& [first, last] : ranges) {
    if (first > last || syscall(SYS_close_range, first, last, 0) == 0) continue;
    const unsigned most = static_cast<unsigned>(std::min(sysconf(_SC_OPEN_MAX), 65536L));
    for (unsigned file = first; file <= std::min(last, most); ++file) close(static_cast<int>(file));
  }
}

int milliseconds_since(const timespec& begin) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<int>((now.tv_sec - begin.tv_sec) * 1000 + (now.tv_nsec - begin.tv_nsec) / 1000000);
}

/// Kills children, those that come to a subreaper too, until there are none, for ten seconds at most.
void kill_children() {
  timespec begin{};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  for (;;) {
    pid_t ended;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) continue;
    if (ended < 0 || milliseconds_since(begin) > 10000) return;
    char text[4096];
    const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text);
    if (file >= 0) close(file);
    pid_t child = 0;
    for (ssize_t i = 0; i < size; ++i) {  // a number that the end cuts off is not followed by a blank
      if (text[i] >= '0' && text[i] <= '9') {
        child = 10 * child + (text[i] - '0');
      } else {
        if (child > 0) kill(child, SIGKILL);
        child = 0;
      }
    }
    usleep(1000);
  }
}

constexpr int grace_milliseconds = 200;  // in which children of a program that has ended may end too
constexpr int try_without_users = -1;    // no error of the system's: the maps of users could not be written

/// The watcher's work. `hold` is closed by the parent when time is up.
[[noreturn]] void watch(const Call& call, unsigned long flags, const UserMaps& users, int exec_error, int report,
                        int hold) {
  setpgid(0, 0);  // what a terminal sends to the parent's group is not for it
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd parent{exec_error, 0, 0};
  if (poll(&parent, 1, 0) > 0) _exit(127);  // it ended before it could have been seen to
  if ((flags & CLONE_NEWUSER) && !users.apply()) {
    const int error = try_without_users;
    [[maybe_unused]] const ssize_t told = write(exec_error, &error, sizeof error);
    _exit(127);
  }
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  signal(SIGCHLD, SIG_DFL);
  sigset_t child_ended, before;
  sigemptyset(&child_ended);
  sigaddset(&child_ended, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child_ended, &before);
  const pid_t program = clone_process(0);
  if (program == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    signal(SIGPIPE, SIG_DFL);
    call.become(exec_error);
  }
  if (program < 0) {
    const int error = errno;
    [[maybe_unused]] const ssize_t told = write(exec_error, &error, sizeof error);
    _exit(127);
  }
  close_all_but(report, hold);
  const int ends = signalfd(-1, &child_ended, SFD_CLOEXEC);
  WatcherReport told{};
  bool ended = false, time_is_up = false;
  timespec end{};
  for (;;) {
    int status = 0;
    rusage usage{};
    const pid_t one = wait4(-1, &status, WNOHANG, &usage);
    if (one == program) {
      told.status = status, told.usage = usage, ended = true;
      clock_gettime(CLOCK_MONOTONIC, &end);
    }
    if (one > 0) continue;
    const int left = ended ? grace_milliseconds - milliseconds_since(end) : -1;
    told.left_children = ended && one == 0;
    if (ended && (one < 0 || left <= 0 || time_is_up)) break;
    pollfd events[2] = {{ends, POLLIN, 0}, {time_is_up ? -1 : hold, POLLIN, 0}};
    poll(events, 2, left);
    if (events[1].revents != 0) {
      time_is_up = true;
      kill(program, SIGKILL);
    }
    signalfd_siginfo taken;
    if (events[0].revents != 0) [[maybe_unused]]
      const ssize_t size = read(ends, &taken, sizeof taken);
  }
  if (!(flags & CLONE_NEWPID)) kill_children();
  [[maybe_unused]] const ssize_t size = write(report, &told, sizeof told);
  _exit(0);
}

/// Starts a watcher and the program; hands back the watcher.
pid_t start_watched(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                    const std::vector<std::string>& extra_env, const StandardFiles& files, const Pipe& report,
                    const Pipe& hold) {
  const Call call(argv, cwd, extra_env, files);
  const UserMaps users;
  int error = 0;
  for (const unsigned long flags : {CLONE_NEWPID, CLONE_NEWUSER | CLONE_NEWPID, 0}) {
    Pipe exec_error;
    const pid_t watcher = clone_process(flags);
    if (watcher == 0) watch(call, flags, users, exec_error.write_end, report.write_end, hold.read_end);
    if (watcher < 0) {
      error = errno;
      continue;
    }
    error = number_from(exec_error);
    if (error == 0) return watcher;
    waitpid(watcher, nullptr, 0);
    if (error != try_without_users) break;
  }
  throw CannotStart(argv[0], std::strerror(error));
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

namespace {

ProgramResult run_watched(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env, double timeout) {
  Pipe out, err, report, hold;
  const pid_t watcher = start_watched(argv, cwd, extra_env, {-1, out.write_end, err.write_end}, report, hold);
  const std::string space = pid_namespace_of(std::to_string(watcher));
  for (Pipe* pipe : {&out, &err, &report}) Pipe::close_end(pipe->write_end);
  Pipe::close_end(hold.read_end);
  for (Pipe* pipe : {&out, &err}) fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  ProgramResult result;
  for (;;) {
    drain(out, result.out, false), drain(err, result.err, false);
    const double left = std::chrono::duration<double>(limit - Clock::now()).count();
    if ((result.timed_out = left <= 0)) break;
    pollfd wait[3] = {{report.read_end, POLLIN, 0}, {out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 3, static_cast<int>(std::min(1000. * left + 1, 1e6)));
    if (wait[0].revents != 0) break;
  }
  Pipe::close_end(hold.write_end);
  // it reports when all has ended, at the latest ten seconds after time is up; one that was stopped does not
  pollfd reported{report.read_end, POLLIN, 0};
  int ready;
  while ((ready = poll(&reported, 1, 12000)) < 0 && errno == EINTR) continue;
  if (ready <= 0) kill(watcher, SIGKILL);
  wait_for(watcher, result);
  // nobody else could tell that those inside have ended; 0: the watcher had, before it was looked at
  if (space != "0" && space != pid_namespace_of()) remove_temporary_folders_of(space);
  WatcherReport told{};
  fcntl(report.read_end, F_SETFL, O_NONBLOCK);
  result.killed_watcher = read(report.read_end, &told, sizeof told) != sizeof told;
  if (!result.killed_watcher) {
    set_end(told.status, told.usage, result);
    result.left_children = told.left_children;
  }
  drain(out, result.out, false), drain(err, result.err, false);
  keep_last(result.out, kept_bytes), keep_last(result.err, kept_bytes);
  return result;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env, std::optional<double> timeout) {
  if (argv.empty()) throw std::runtime_error("run_program: no program named");
  if (timeout) return run_watched(argv, cwd, extra_env, *timeout);
  Pipe out, err;
  const pid_t child = start(argv, cwd, extra_env, {-1, out.write_end, err.write_end});
  for (Pipe* pipe : {&out, &err}) {
    Pipe::close_end(pipe->write_end);
    fcntl(pipe->read_end, F_SETFL, O_NONBLOCK);
  }
  ProgramResult result;
  for (;;) {
    drain(out, result.out, true), drain(err, result.err, true);
    if (out.read_end < 0 && err.read_end < 0) break;
    pollfd wait[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    poll(wait, 2, -1);
  }
  wait_for(child, result);
  return result;
}

int run_in_terminal(const std::vector<std::string>& argv) {
  ProgramResult result;
  wait_for(start(argv, ".", {}, {0, 1, 2}), result);
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
    child_ = start(argv, ".", {}, {ends[1], -1, err_});
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
