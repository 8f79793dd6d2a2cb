#include "tests/coursework/grader/spawn.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <grp.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string_view>

#include "mysim/base/files.h"
#include "mysim/base/process.h"

namespace coursework {
namespace {

constexpr int above = 32;  // our descriptors have larger numbers than those of the program

void close_from(int first) {
  if (syscall(SYS_close_range, first, ~0u, 0) == 0) return;
  rlimit files{};  // kernels before 5.9
  getrlimit(RLIMIT_NOFILE, &files);
  for (int fd = first; fd < static_cast<int>(files.rlim_cur); ++fd) close(fd);
}

bool become(unsigned user) {
  return setgroups(0, nullptr) == 0 && setresgid(user, user, user) == 0 && setresuid(user, user, user) == 0;
}

void set_limit(int what, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  setrlimit(static_cast<__rlimit_resource>(what), &both);
}

[[noreturn]] void fail(const ChildSetup& setup, const char* what) {
  ChildStatus report;
  report.failed = what;
  report.error = errno;
  [[maybe_unused]] const ssize_t written = write(setup.report, &report, sizeof report);
  _exit(127);
}

[[noreturn]] void exec_program(const ChildSetup& setup, pid_t parent) {
  setsid();
  umask(077);
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_NOFILE, 256, 256);
  set_limit(RLIMIT_STACK, 8 << 20, 8 << 20);
  set_limit(RLIMIT_FSIZE, setup.file, setup.file);
  set_limit(RLIMIT_NPROC, setup.processes, setup.processes);
  set_limit(RLIMIT_CPU, setup.cpu, setup.cpu + 1);  // SIGXCPU, and if it is ignored, SIGKILL one second later
  set_limit(RLIMIT_AS, setup.memory, setup.memory);
  if (setup.user && !become(setup.user)) fail(setup, "change to another user");
  if (chdir(setup.folder) != 0) fail(setup, "enter the folder it starts in");
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (setup.filter) {
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail(setup, "give up new privileges");
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, setup.filter) != 0)
      fail(setup, "install the filter of system calls");
  }
  // If another of our threads forked while this program was being written, the forked child keeps the program open for
  // writing until it has closed the inherited descriptors. Only after that can the program be started.
  const timespec moment{0, 1000000};
  for (int waited = 0; waited < 2000; ++waited) {
    execve(setup.command[0], setup.command, setup.environment);
    if (errno != ETXTBSY) break;
    nanosleep(&moment, nullptr);
  }
  fail(setup, "start the program");
}

/// Kills the current children of this process, among them the program's orphans, which it has adopted.
void kill_children() {
  char text[4096];
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text - 1);
  if (file >= 0) close(file);
  if (size <= 0) return;
  text[size] = '\0';
  char* at = text;
  while (const pid_t child = static_cast<pid_t>(std::strtol(at, &at, 10))) {
    if (*at == '\0') break;  // each number ends with a blank, so this number is incomplete
    kill(child, SIGKILL);
  }
}

/// Adds resource usage, because this process also waits for zombies that a program leaves behind.
void add_usage(rusage& sum, const rusage& more) {
  timeradd(&sum.ru_utime, &more.ru_utime, &sum.ru_utime);
  timeradd(&sum.ru_stime, &more.ru_stime, &sum.ru_stime);
  if (sum.ru_maxrss < more.ru_maxrss) sum.ru_maxrss = more.ru_maxrss;
}

void kill_descendants(const ChildSetup& setup, rusage& used) {
  for (;;) {
    if (setup.user) {
      const pid_t killer = fork();
      if (killer == 0) {
        if (become(setup.user)) kill(-1, SIGKILL);
        _exit(0);
      }
      if (killer > 0) waitpid(killer, nullptr, 0);
    }
    kill_children();
    pid_t ended;
    rusage its{};
    while ((ended = wait4(-1, nullptr, WNOHANG, &its)) > 0) add_usage(used, its);
    if (ended < 0 && errno == ECHILD) return;
    const timespec shortly{0, 1000000};
    nanosleep(&shortly, nullptr);
  }
}

}  // namespace

void supervise(const ChildSetup& setup) {
  // The descriptors are above their target numbers, so none of them is overwritten before it is copied.
  for (int i = 0; i < setup.count; ++i) dup2(setup.descriptors[i], i);
  ChildSetup own = setup;
  own.report = dup2(setup.report, setup.count);
  fcntl(own.report, F_SETFD, FD_CLOEXEC);
  // If the grader is killed, the user must stay reserved until this process has killed all of the user's processes.
  own.lock = dup2(setup.lock, own.report + 1);
  if (own.lock >= 0) fcntl(own.lock, F_SETFD, FD_CLOEXEC);
  close_from(std::max(own.report, own.lock) + 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t waited;
  sigemptyset(&waited);
  sigaddset(&waited, SIGTERM);
  sigaddset(&waited, SIGCHLD);
  const pid_t self = getpid();
  const pid_t program = fork();
  if (program < 0) fail(own, "start a process");
  if (program == 0) exec_program(own, self);
  ChildStatus report;
  for (;;) {
    rusage its{};
    const pid_t ended = wait4(-1, &report.status, WNOHANG, &its);
    if (ended > 0) add_usage(report.used, its);
    if (ended == program) break;
    if (ended > 0) continue;
    siginfo_t what{};
    if (sigwaitinfo(&waited, &what) == SIGTERM) kill(program, SIGKILL);
  }
  kill_descendants(own, report.used);
  [[maybe_unused]] const ssize_t written = write(own.report, &report, sizeof report);
  _exit(0);
}

namespace {

bool says_memory(const ProcessResult& ended) {
  const std::string_view answers = ended.answers;
  constexpr std::string_view word = "memory\n";
  if (answers.ends_with(word) && (answers.size() == word.size() || answers[answers.size() - word.size() - 1] == '\n'))
    return true;
  for (const std::string_view phrase : {"bad_alloc", "out of memory", "memory exhausted"})
    if (ended.captured_output.find(phrase) != std::string::npos) return true;
  return false;
}

}  // namespace

End classify(ProcessResult ended, const Limits& limits, bool shell) {
  End end{End::How::exited, 0, std::move(ended.answers), std::move(ended.captured_output), 0};
  ended.answers = end.answers;
  ended.captured_output = end.captured_output;
  int signal = WIFSIGNALED(ended.status) ? WTERMSIG(ended.status) : 0;
  const int code = WIFEXITED(ended.status) ? WEXITSTATUS(ended.status) : 0;
  if (shell && code > 128 && code < 128 + NSIG) signal = code - 128;
  end.code = signal ? signal : code;
  const double cpu = crosscheck::cpu_seconds(ended.used);
  // ru_maxrss is in kB. The limit is on mapped memory, which exceeds resident memory: hence three quarters.
  const bool full = static_cast<double>(ended.used.ru_maxrss) > 0.75 * 1024 * static_cast<double>(limits.memory);
  end.cpu = cpu;
  if (ended.wall)
    end.how = End::How::wall;
  else if (ended.idle)
    end.how = End::How::idle;
  else if (ended.full)
    end.how = End::How::answers;
  else if (ended.output || signal == SIGXFSZ)
    end.how = End::How::output;
  else if (signal == SIGXCPU || cpu > limits.cpu)
    end.how = End::How::cpu;
  else if ((end.code != 0 && says_memory(ended)) || (signal == SIGKILL && full))
    end.how = End::How::memory;
  else if (signal)
    end.how = End::How::signal;
  return end;
}

void Descriptor::reset() {
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
}

Pipe::Pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("no pipe: {}", std::strerror(errno)));
  from = Descriptor(fcntl(ends[0], F_DUPFD_CLOEXEC, above));
  to = Descriptor(fcntl(ends[1], F_DUPFD_CLOEXEC, above));
  close(ends[0]);
  close(ends[1]);
  if (from.get() < 0 || to.get() < 0) throw std::runtime_error("no pipe: too many open files");
}

namespace {

constexpr std::size_t most_captured = 64 << 10;
/// Blocks signals that would disturb this thread during communication. The destructor restores the signal mask.
class BlockedSignals {
 public:
  BlockedSignals() {
    for (const int number : {SIGPIPE, SIGTERM, SIGCHLD}) sigaddset(&ours_, number);
    pthread_sigmask(SIG_BLOCK, &ours_, &before_);
  }
  ~BlockedSignals() {
    sigset_t pipe{};
    sigaddset(&pipe, SIGPIPE);
    const timespec at_once{};
    if (!sigismember(&before_, SIGPIPE)) sigtimedwait(&pipe, nullptr, &at_once);  // one of our own writes has raised it
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t ours_{}, before_{};
};

/// Reads the available data, and keeps up to `most` bytes in total. Returns false at the end of file.
bool read_available(int fd, std::string& kept, std::size_t most, std::size_t& seen) {
  char block[65536];
  ssize_t got;
  while ((got = read(fd, block, sizeof block)) > 0) {
    seen += static_cast<std::size_t>(got);
    kept.append(block, std::min(static_cast<std::size_t>(got), most - std::min(most, kept.size())));
    if (seen > most + sizeof block) break;
  }
  return got != 0;
}

/// Measures for how long no process of a program has run. Waiting for a processor counts as running, so that a program
/// is not regarded as idle on a machine under load.
class IdleWatch {
 public:
  explicit IdleWatch(pid_t supervisor) : supervisor_(supervisor) {}

  /// Seconds without activity, updated once per second.
  double seconds() {
    const auto now = Clock::now();
    if (now - looked_ >= std::chrono::seconds(1)) {
      looked_ = now;
      if (anything_runs(supervisor_)) ran_ = now;
    }
    return std::chrono::duration<double>(now - ran_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// True if any thread of this process's descendants is not in interruptible sleep, or if this cannot be determined.
  static bool anything_runs(pid_t parent) {
    const std::string children =
        crosscheck::try_read_file(fmt::format("/proc/{0}/task/{0}/children", parent)).value_or("");
    const char* at = children.c_str();
    char* end = nullptr;
    for (long child; (child = std::strtol(at, &end, 10)) > 0 && end != at; at = end) {
      std::error_code gone;
      std::filesystem::directory_iterator thread(fmt::format("/proc/{}/task", child), gone), last;
      for (; !gone && thread != last; thread.increment(gone)) {
        const std::string stat = crosscheck::try_read_file(thread->path() / "stat").value_or("");
        const std::size_t name = stat.rfind(") ");
        if (name == std::string::npos || stat[name + 2] != 'S') return true;
      }
      if (gone || anything_runs(static_cast<pid_t>(child))) return true;
    }
    return false;
  }

  pid_t supervisor_;
  Clock::time_point looked_ = Clock::now(), ran_ = looked_;
};

/// Writes the input, reads the outputs and watches the clock until the supervisor reports.
ChildStatus communicate(const SpawnOptions& start, pid_t supervisor, Pipe& in, Pipe& answers, Pipe& captured_output,
                        Pipe& reports, ProcessResult& ended) {
  for (Pipe* pipe : {&answers, &captured_output, &reports}) {
    pipe->to.reset();
    fcntl(pipe->from.get(), F_SETFL, O_NONBLOCK);
  }
  in.from.reset();
  fcntl(in.to.get(), F_SETFL, O_NONBLOCK);
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(start.limits.wall);
  const auto most = static_cast<std::size_t>(start.limits.output) << 10,
             most_answers = static_cast<std::size_t>(start.limits.answers) << 10;
  IdleWatch idle(supervisor);
  std::size_t fed = 0, answered = 0, captured = 0;
  bool stopped = false;
  ChildStatus report;
  for (;;) {
    if (fed == start.input.size()) in.to.reset();
    pollfd watched[] = {{reports.from.get(), POLLIN, 0},
                        {answers.from.get(), POLLIN, 0},
                        {captured_output.from.get(), POLLIN, 0},
                        {in.to.get(), POLLOUT, 0}};
    const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
    poll(watched, std::size(watched), stopped ? -1 : std::clamp(static_cast<int>(std::ceil(left * 1e3)), 0, 1000));
    if (watched[3].revents) {
      const ssize_t wrote = write(in.to.get(), start.input.data() + fed, start.input.size() - fed);
      fed = wrote > 0 ? fed + static_cast<std::size_t>(wrote) : errno == EAGAIN ? fed : start.input.size();
    }
    // The report comes after all processes of the program have ended, so their output is in the pipes by then.
    const bool reported = watched[0].revents;
    if (!read_available(answers.from.get(), ended.answers, most_answers, answered)) answers.from.reset();
    if (!read_available(captured_output.from.get(), ended.captured_output, most_captured, captured))
      captured_output.from.reset();
    if (!stopped) ended.full = answered > most_answers, ended.output = captured > most;
    if (reported) {
      if (read(reports.from.get(), &report, sizeof report) != sizeof report)
        report.failed = "watch over the program (its supervisor was killed)";
      return report;
    }
    if (!stopped && !ended.output && !ended.full) {
      ended.wall = Clock::now() >= deadline;
      ended.idle = !ended.wall && idle.seconds() >= start.limits.idle;
    }
    if (!stopped && (ended.output || ended.full || ended.wall || ended.idle)) {
      kill(supervisor, SIGTERM);
      stopped = true;
    }
  }
}

}  // namespace

ProcessResult spawn(const SpawnOptions& start) {
  const auto command = crosscheck::c_strings(start.command), environment = crosscheck::c_strings(start.environment);
  const sock_fprog filter{static_cast<unsigned short>(start.filter.size() / sizeof(sock_filter)),
                          reinterpret_cast<sock_filter*>(const_cast<char*>(start.filter.data()))};
  Pipe in, answers, captured_output, reports;
  std::vector<int> descriptors{in.from.get(), captured_output.to.get(), captured_output.to.get(), answers.to.get()};
  descriptors.insert(descriptors.end(), start.passed.begin(), start.passed.end());
  const std::string folder = start.folder.string();
  const Descriptor lock(start.lock < 0 ? -1 : fcntl(start.lock, F_DUPFD_CLOEXEC, above));
  const ChildSetup setup{command.data(),
                         environment.data(),
                         folder.c_str(),
                         start.user,
                         start.filter.empty() ? nullptr : &filter,
                         descriptors.data(),
                         static_cast<int>(descriptors.size()),
                         reports.to.get(),
                         lock.get(),
                         static_cast<rlim_t>(std::ceil(start.limits.cpu)),
                         static_cast<rlim_t>(start.limits.memory) << 20,
                         static_cast<rlim_t>(start.limits.file) << 20,
                         static_cast<rlim_t>(start.processes)};
  const BlockedSignals blocked;
  const pid_t supervisor = fork();
  if (supervisor < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (supervisor == 0) supervise(setup);
  ProcessResult ended;
  const ChildStatus report = communicate(start, supervisor, in, answers, captured_output, reports, ended);
  waitpid(supervisor, nullptr, 0);
  if (report.failed)
    throw std::runtime_error(fmt::format("{}: cannot {}: {}", start.command[0], report.failed,
                                         report.error ? std::strerror(report.error) : "no report"));
  ended.status = report.status;
  ended.used = report.used;
  return ended;
}

}  // namespace coursework
