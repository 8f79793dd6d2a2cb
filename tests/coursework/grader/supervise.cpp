#include "tests/coursework/grader/supervise.h"

#include <fcntl.h>
#include <grp.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>

namespace coursework {
namespace {

void close_from(int first) {
  if (syscall(SYS_close_range, first, ~0u, 0) == 0) return;
  rlimit files{};  // kernels before 5.9
  getrlimit(RLIMIT_NOFILE, &files);
  for (int fd = first; fd < static_cast<int>(files.rlim_cur); ++fd) close(fd);
}

bool become(unsigned user) {
  return setgroups(0, nullptr) == 0 && setresgid(user, user, user) == 0 && setresuid(user, user, user) == 0;
}

void limit(int what, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  setrlimit(static_cast<__rlimit_resource>(what), &both);
}

[[noreturn]] void fail(const Plan& plan, const char* what) {
  Report report;
  report.failed = what;
  report.error = errno;
  [[maybe_unused]] const ssize_t written = write(plan.report, &report, sizeof report);
  _exit(127);
}

[[noreturn]] void start(const Plan& plan, pid_t parent) {
  setsid();
  umask(077);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_NOFILE, 256, 256);
  limit(RLIMIT_STACK, 8 << 20, 8 << 20);
  limit(RLIMIT_FSIZE, plan.file, plan.file);
  limit(RLIMIT_NPROC, plan.processes, plan.processes);
  limit(RLIMIT_CPU, plan.cpu, plan.cpu + 1);  // SIGXCPU, and a second later SIGKILL for those who swallow it
  limit(RLIMIT_AS, plan.memory, plan.memory);
  if (plan.user && !become(plan.user)) fail(plan, "change to another user");
  if (chdir(plan.folder) != 0) fail(plan, "enter the folder it starts in");
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (plan.filter) {
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail(plan, "give up new privileges");
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, plan.filter) != 0) fail(plan, "install the filter of system calls");
  }
  // A thread of ours that forked while another wrote this program holds it open until it has closed what it inherited,
  // and as long it cannot be started.
  const timespec moment{0, 1000000};
  for (int waited = 0; waited < 2000; ++waited) {
    execve(plan.command[0], plan.command, plan.environment);
    if (errno != ETXTBSY) break;
    nanosleep(&moment, nullptr);
  }
  fail(plan, "start the program");
}

/// Kills the children that this process has by now: the program's orphans come to it.
void kill_children() {
  char text[4096];
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text - 1);
  if (file >= 0) close(file);
  if (size <= 0) return;
  text[size] = '\0';
  char* at = text;
  while (const pid_t child = static_cast<pid_t>(std::strtol(at, &at, 10))) {
    if (*at == '\0') break;  // each number ends with a blank: this one was cut off
    kill(child, SIGKILL);
  }
}

/// The sum of all, since a program may leave its dead to us.
void add(rusage& sum, const rusage& more) {
  timeradd(&sum.ru_utime, &more.ru_utime, &sum.ru_utime);
  timeradd(&sum.ru_stime, &more.ru_stime, &sum.ru_stime);
  if (sum.ru_maxrss < more.ru_maxrss) sum.ru_maxrss = more.ru_maxrss;
}

void sweep(const Plan& plan, rusage& used) {
  for (;;) {
    if (plan.user) {
      const pid_t killer = fork();
      if (killer == 0) {
        if (become(plan.user)) kill(-1, SIGKILL);
        _exit(0);
      }
      if (killer > 0) waitpid(killer, nullptr, 0);
    }
    kill_children();
    pid_t ended;
    rusage its{};
    while ((ended = wait4(-1, nullptr, WNOHANG, &its)) > 0) add(used, its);
    if (ended < 0 && errno == ECHILD) return;
    const timespec shortly{0, 1000000};
    nanosleep(&shortly, nullptr);
  }
}

}  // namespace

void supervise(const Plan& plan) {
  // The descriptors were made above the numbers that they get here, so that none is overwritten before its turn.
  for (int i = 0; i < plan.count; ++i) dup2(plan.descriptors[i], i);
  Plan own = plan;
  own.report = dup2(plan.report, plan.count);
  fcntl(own.report, F_SETFD, FD_CLOEXEC);
  close_from(own.report + 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t waited;
  sigemptyset(&waited);
  sigaddset(&waited, SIGTERM);
  sigaddset(&waited, SIGCHLD);
  const pid_t self = getpid();
  const pid_t program = fork();
  if (program < 0) fail(own, "start a process");
  if (program == 0) start(own, self);
  Report report;
  for (;;) {
    rusage its{};
    const pid_t ended = wait4(-1, &report.status, WNOHANG, &its);
    if (ended > 0) add(report.used, its);
    if (ended == program) break;
    if (ended > 0) continue;
    siginfo_t what{};
    if (sigwaitinfo(&waited, &what) == SIGTERM) kill(program, SIGKILL);
  }
  sweep(own, report.used);
  [[maybe_unused]] const ssize_t written = write(own.report, &report, sizeof report);
  _exit(0);
}

}  // namespace coursework
