// fork, sigwaitinfo, and the processes that lose their parents.
#include "mysim/supervised.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <sstream>

#include "mysim/output_folder.h"
#include "mysim/temporary_folder.h"

namespace crosscheck {
namespace {

// the number of a file in memory, which parent and child share, and programs that they start do not
constexpr auto notes_variable = "CROSSCHECK_SUPERVISOR";

/// Those that end a program, unless who started it had them ignored.
sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&set, number);
  }
  return set;
}

void signal_children(int number) {
  char text[4096];
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  const ssize_t size = file < 0 ? 0 : read(file, text, sizeof text - 1);
  if (file >= 0) close(file);
  std::istringstream all(std::string(text, static_cast<size_t>(std::max<ssize_t>(0, size))));
  for (pid_t child; all >> child && !all.eof();) kill(child, number);
}

/// What lost its parent came to this process. It may tidy up first.
void end_descendants() {
  using Clock = std::chrono::steady_clock;
  const auto patience = Clock::now() + std::chrono::seconds(2), despair = patience + std::chrono::seconds(10);
  for (bool first = true;; first = false) {
    pid_t ended;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (ended < 0 || Clock::now() > despair) return;
    if (first || Clock::now() > patience) signal_children(first ? SIGTERM : SIGKILL);
    usleep(2000);
  }
}

int status_of_child(pid_t child, const sigset_t& waited) {
  for (;;) {
    int status = 0;
    for (pid_t ended; (ended = waitpid(-1, &status, WNOHANG)) > 0;)
      if (ended == child) return status;
    const int number = sigwaitinfo(&waited, nullptr);
    if (number > 0 && number != SIGCHLD) kill(child, number);
  }
}

void tidy_results(int notes) {
  std::string text;
  char block[4096];
  off_t at = 0;
  for (ssize_t got; (got = pread(notes, block, sizeof block, at)) > 0; at += got)
    text.append(block, static_cast<size_t>(got));
  for (size_t begin = 0, end; (end = text.find('\0', begin)) != std::string::npos; begin = end + 1) try {
      recover_output(text.substr(begin, end - begin));
    } catch (const std::exception&) {
      // somebody else is at it by now, or the next start with this folder will say what is wrong
    }
}

[[noreturn]] void end_as(int status) {
  if (WIFEXITED(status)) _exit(WEXITSTATUS(status));
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);  // it has written its own
  const int number = WTERMSIG(status);
  signal(number, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, number);
  sigprocmask(SIG_UNBLOCK, &only, nullptr);
  raise(number);
  _exit(128 + number);
}

}  // namespace

int supervised(const std::function<int()>& work) {
  const pid_t self = getpid();
  sigset_t waited = ending_signals(), before;
  sigaddset(&waited, SIGCHLD);
  const int notes = memfd_create("crosscheck", MFD_CLOEXEC);
  sigprocmask(SIG_BLOCK, &waited, &before);
  const pid_t child = fork();
  if (child <= 0) {
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != self) _exit(1);
      if (notes >= 0) setenv(notes_variable, fmt::format("{}", notes).c_str(), 1);
    }
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return work();
  }
  signal(SIGCHLD, SIG_DFL);  // or, where who started this ignores it, nobody could be waited for
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sweep_temporary_folders();
  const int status = status_of_child(child, waited);
  end_descendants();
  sweep_temporary_folders();
  if (notes >= 0) tidy_results(notes);
  end_as(status);
}

void tell_supervisor(const std::string& folder) {
  const char* number = std::getenv(notes_variable);
  if (!number) return;
  const int notes = std::atoi(number);
  // in a program that was started by another, the number means nothing
  if (fcntl(notes, F_GET_SEALS) < 0 || lseek(notes, 0, SEEK_END) < 0) return;
  [[maybe_unused]] const ssize_t written = write(notes, folder.c_str(), folder.size() + 1);
}

}  // namespace crosscheck
