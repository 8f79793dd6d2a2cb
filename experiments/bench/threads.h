// Two threads beside one: the same steps of the same sheet, by the clock on the wall.
#pragma once

#include <vector>

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"
#include "mysim/base/progress.h"

namespace crosscheck {

struct ThreadsOptions {
  std::vector<int> sides;  // particles along a side of each sheet
  TimedRunOptions turns;
};

/// `bench-threads-cost`: wall time of a step of leapfrog with one thread and with +threads=2, which may take one where
/// a sheet is small, and their ratio, round by round; and the share of the time of the cores that the threads got while
/// they were timed: threads that wait look again and again, so that what is missing somebody else had, and the ratio is
/// then less than the machine can give. A note says so below 95 %, and where there is one core only. Call it before the
/// process is bound to a core.
void two_threads(const ThreadsOptions& asked, Rows& rows, Progress& progress);

}  // namespace crosscheck
