#include "mysim/base/this_process.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>

#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/process.h"

namespace crosscheck {
namespace {

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Duration of a clock reading (s): median of 101, measured once.
double time_of_reading() {
  static const double median = [] {
    std::array<double, 101> pairs;
    for (double& pair : pairs) {
      const double first = now();
      pair = now() - first;
    }
    std::ranges::nth_element(pairs, pairs.begin() + 50);
    return pairs[50];
  }();
  return median;
}

}  // namespace

void CpuClock::start() {
  if (!runs_) return;
  time_of_reading();  // measured outside the timed interval
  begin_ = now();
}

void CpuClock::stop() {
  if (runs_) total_ = std::max(total_ + now() - begin_ - time_of_reading(), 1e-9);
}

namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file, or after a given word; nothing if there is no number ("max").
std::optional<double> number_of_file(const fs::path& file, std::string_view word = "") {
  std::ifstream in(file);
  for (std::string key; !word.empty() && in >> key && key != word;) in.ignore(100, '\n');
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// Memory left by this process's control groups (version 1 or 2) on all levels up to the root. Adds inactive file
/// caches, which the groups count as used, although the kernel releases them on demand.
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
      const auto cached = number_of_file(group / "memory.stat", both ? "inactive_file" : "total_inactive_file");
      if (limit && used) least = std::min(least, *limit - *used + cached.value_or(0));
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

double free_memory() {
  const auto available = number_of_file("/proc/meminfo", "MemAvailable:");  // KiB
  return std::min({available ? 1024 * *available : unlimited, left_by_groups(), left_of_address_space()});
}

namespace {

/// Result folders that workers write, as null-terminated texts. Shared by the supervisor and its workers, but not by
/// programs that they start.
struct Notes {
  std::atomic<size_t> used;
  char text[1 << 16];
};
Notes* notes = nullptr;

/// Signals that end this process, except those that it ignores because its parent did.
sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(&set, number);
  }
  return set;
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

void tidy_results() {
  const size_t used = std::min<size_t>(notes->used, sizeof notes->text);
  for (size_t at = 0; at < used; at += std::strlen(notes->text + at) + 1) try {
      if (notes->text[at]) recover_output(notes->text + at);
    } catch (const std::exception&) {
      // another process is cleaning up, or the next start with this folder reports the problem
    }
}

[[noreturn]] void end_as(int status) {
  if (WIFEXITED(status)) _exit(WEXITSTATUS(status));
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);  // the child has dumped core itself
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
  void* shared = mmap(nullptr, sizeof(Notes), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  notes = shared == MAP_FAILED ? nullptr : static_cast<Notes*>(shared);
  sigprocmask(SIG_BLOCK, &waited, &before);
  const pid_t child = fork();
  if (child <= 0) {
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != self) _exit(1);
    }
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return work();
  }
  signal(SIGCHLD, SIG_DFL);  // if the parent ignored SIGCHLD, children could not be waited for
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  remove_stale_temporary_folders();
  const int status = status_of_child(child, waited);
  end_children(std::chrono::seconds(2));
  remove_stale_temporary_folders();
  if (notes) tidy_results();
  if (WIFSIGNALED(status) && !when_interrupted.empty())
    fmt::print(stderr, "\ncrosscheck: interrupted; {}\n", when_interrupted);
  end_as(status);
}

void register_output(const std::string& folder) {
  if (!notes) return;
  const size_t at = notes->used.fetch_add(folder.size() + 1);
  if (at + folder.size() < sizeof notes->text) std::memcpy(notes->text + at, folder.data(), folder.size());
}

}  // namespace crosscheck
