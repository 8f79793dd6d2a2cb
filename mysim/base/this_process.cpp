// Thread clock, memory left, and supervision by a parent.
#include "mysim/base/this_process.h"

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
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/output_folder.h"

namespace crosscheck {
namespace {

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

void CpuClock::start() {
  if (runs_) begin_ = now();
}

void CpuClock::stop() {
  if (runs_) total_ += now() - begin_;
}

namespace fs = std::filesystem;
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double available_to_all() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (double kib = 0; std::sscanf(line.c_str(), "MemAvailable: %lf", &kib) == 1) return 1024 * kib;
  return unlimited;
}

/// A number in a file; nothing where there is none ("max").
std::optional<double> number_of_file(const fs::path& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// Bytes of files that the group's memory holds and gives up when it is needed: counted as used there.
double given_up_by_group(const fs::path& group, std::string_view key) {
  std::ifstream in(group / "memory.stat");
  double bytes = 0;
  for (std::string word; in >> word >> bytes;)
    if (word == key) return bytes;
  return 0;
}

/// The memory that the groups of this process leave, version 2 or 1, each one up to the root.
double left_by_groups() {
  double least = unlimited;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool both = controllers.empty();  // version 2
    if (!both && controllers.find("memory") == std::string::npos) continue;
    const fs::path root = both ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    std::string at = line.substr(second + 1);
    for (;; at = at.substr(0, at.rfind('/'))) {
      const fs::path group = root / fs::path(at).relative_path();
      const auto limit = number_of_file(group / (both ? "memory.max" : "memory.limit_in_bytes"));
      const auto used = number_of_file(group / (both ? "memory.current" : "memory.usage_in_bytes"));
      if (limit && used)
        least =
            std::min(least, *limit - *used + given_up_by_group(group, both ? "inactive_file" : "total_inactive_file"));
      if (at.find_first_not_of('/') == std::string::npos) break;
    }
  }
  return std::max(least, 0.);
}

double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return std::max(0., static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

double free_memory() { return std::min({available_to_all(), left_by_groups(), left_of_address_space()}); }

namespace {

// the number of a file in memory, which parent and child share, and programs that they start do not
constexpr auto notes_variable = "CROSSCHECK_SUPERVISOR";

/// Signals that end a program, unless its parent had them ignored.
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

/// Ends all descendants: orphans became children of this process. Each has two seconds to tidy up before it is killed.
void end_descendants() {
  using Clock = std::chrono::steady_clock;
  const auto kill_after = Clock::now() + std::chrono::seconds(2), give_up_after = kill_after + std::chrono::seconds(10);
  for (bool first = true;; first = false) {
    pid_t ended;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (ended < 0 || Clock::now() > give_up_after) return;
    if (first || Clock::now() > kill_after) signal_children(first ? SIGTERM : SIGKILL);
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
      // another process does it by now, or the next start with this folder will say what is wrong
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

int run_supervised(const std::function<int()>& work, const std::string& when_interrupted) {
  print_only_text();
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
  signal(SIGCHLD, SIG_DFL);  // or, where the parent ignores it, no child could be waited for
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  remove_stale_temporary_folders();
  const int status = status_of_child(child, waited);
  end_descendants();
  remove_stale_temporary_folders();
  if (notes >= 0) tidy_results(notes);
  if (WIFSIGNALED(status) && !when_interrupted.empty())
    fmt::print(stderr, "\ncrosscheck: interrupted; {}\n", when_interrupted);
  end_as(status);
}

void register_output(const std::string& folder) {
  const char* number = std::getenv(notes_variable);
  if (!number) return;
  const int notes = std::atoi(number);
  // in a program that was started by another, the number means nothing
  if (fcntl(notes, F_GET_SEALS) < 0 || lseek(notes, 0, SEEK_END) < 0) return;
  [[maybe_unused]] const ssize_t written = write(notes, folder.c_str(), folder.size() + 1);
}

}  // namespace crosscheck
