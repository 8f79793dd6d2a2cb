// Progress on standard error.
#include "experiments/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace crosscheck {

Progress::Progress(int total)
    : total_(total), terminal_(isatty(STDERR_FILENO)), start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (terminal_ && begun_ > 0) fmt::print(stderr, "\r\033[K");
}

void Progress::begin(const std::string& what) {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string left;
  if (begun_ > 0 && total_ > begun_) left = fmt::format(", about {:.0f} s left", elapsed / begun_ * (total_ - begun_));
  ++begun_;
  fmt::print(stderr, "{}[{}/{}] {} ({:.0f} s{}){}", terminal_ ? "\r\033[K" : "", begun_, std::max(total_, begun_), what,
             elapsed, left, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

void Progress::done() {
  if (terminal_) fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace crosscheck
