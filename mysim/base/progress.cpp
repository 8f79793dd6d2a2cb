#include "mysim/base/progress.h"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <latch>
#include <mutex>
#include <thread>

#include "mysim/base/names.h"

namespace crosscheck {
namespace {

constexpr double silent = 2;  // s; no progress is shown before this time

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 100 * 60) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.1f} h", seconds / 3600);
  if (seconds < 1000 * 86400.) return fmt::format("{:.0f} days", seconds / 86400);
  return fmt::format("{:.2g} years", seconds / (365.25 * 86400));
}

std::string progress_line(const ProgressSnapshot& seen) {
  // the estimate assumes steps of equal length, and is shown only after 1 % of the work
  const bool known = seen.total >= seen.begun;
  const double done = known ? (std::max(seen.begun - 1, 0) + seen.part) / seen.total : 0;
  std::string left;
  if (done > 0.01 && done < 1)
    left = fmt::format(", about {} left", format_duration(seen.elapsed / done * (1 - done)));
  else if (!known && seen.part > 0.01 && seen.part < 1)
    left = fmt::format(", about {} left of this run", format_duration(seen.in_step / seen.part * (1 - seen.part)));
  else if (seen.expected > seen.in_step && seen.part <= 0.01)
    left = fmt::format(", about {} left{}", format_duration(seen.expected - seen.in_step),
                       known && seen.begun == seen.total ? "" : " of this run");
  const std::string number = known && seen.total > 1    ? fmt::format("[{}/{}] ", seen.begun, seen.total)
                             : !known && seen.begun > 1 ? fmt::format("[{}] ", seen.begun)
                                                        : "";
  return fmt::format("{}{} ({}{}{})", number, printable(seen.what),
                     seen.part > 0.01 && seen.part < 1 ? fmt::format("{:.0f} %, ", 100 * seen.part) : "",
                     format_duration(seen.elapsed), left);
}

struct Progress::Display {
  using Clock = std::chrono::steady_clock;

  std::mutex mutex;  // guards all members except `part`
  std::condition_variable_any stopped;
  std::latch ready{1};
  bool shown = false;  // a line is on the terminal
  int total, begun = 0;
  std::string what;  // description of the step; empty if there is nothing to show
  double expected = 0;
  std::atomic<double> part = 0;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const Clock::time_point start = Clock::now();
  Clock::time_point step_start = start;
  double last_line = 0;  // s, time of the last plain line
  const pid_t owner = getpid();
  std::jthread thread;  // last member, therefore destroyed first

  explicit Display(int steps) : total(steps) {
    // the new thread blocks all signals, which leaves them to the working thread
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread = std::jthread([this](const std::stop_token& stop) { look(stop); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ready.wait();
  }

  static double since(Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); }

  static void put(const std::string& text) {
    // unbuffered: a forked child would hold a copy of the buffer
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
  }

  void look(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    ready.count_down();
    while (!stopped.wait_for(lock, stop, std::chrono::milliseconds(250), [&] { return stop.stop_requested(); })) {
      const double elapsed = since(start);
      if (elapsed < silent || begun == 0 || what.empty()) continue;
      // plain lines at growing intervals, at most a minute apart
      if (!terminal && last_line > 0 && elapsed - last_line < std::clamp(elapsed / 4, 5., 60.)) continue;
      std::string line = progress_line({begun, total, part, elapsed, expected, since(step_start), what});
      winsize window{};
      if (terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 4 &&
          line.size() >= window.ws_col)
        line = line.substr(0, window.ws_col - 4) + "...";
      put(terminal ? "\r\033[K" + line : line + "\n");
      shown = terminal;
      last_line = elapsed;
    }
  }
};

Progress::Progress(int total) : display_(std::make_unique<Display>(total)) {}

Progress::~Progress() {
  if (getpid() == display_->owner)
    done();
  else
    static_cast<void>(display_.release());  // a forked child has no thread to join
}

void Progress::begin(const std::string& what, double seconds) {
  const std::lock_guard lock(display_->mutex);
  ++display_->begun;
  display_->what = what;
  display_->expected = seconds;
  display_->part = 0;
  display_->step_start = Display::Clock::now();
}

void Progress::part(double done) { display_->part.store(done, std::memory_order_relaxed); }

void Progress::expect(int more) {
  const std::lock_guard lock(display_->mutex);
  display_->total += more;
}

pid_t Progress::fork() {
  const std::lock_guard lock(display_->mutex);
  return ::fork();
}

void Progress::done() {
  const std::lock_guard lock(display_->mutex);
  if (display_->shown) Display::put("\r\033[K");
  display_->shown = false;
  display_->what.clear();
}

}  // namespace crosscheck
