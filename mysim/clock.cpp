// CPU time by the POSIX thread clock.
#include "mysim/clock.h"

#include <ctime>

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

}  // namespace crosscheck
