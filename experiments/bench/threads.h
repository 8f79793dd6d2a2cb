// Two threads against one: the same steps of the same cloth, by wall-clock time.
#pragma once

#include <vector>

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"
#include "mysim/base/progress.h"

namespace crosscheck {

struct ThreadsOptions {
  std::vector<int> sides;  // particles along a side of each cloth
  TimedRunOptions turns;
};

/// `bench-threads-cost`: wall time of a step of leapfrog with one thread and with +threads=2, which may take one where
/// a cloth is small, and their ratio, round by round; and the share of the time of the cores that the threads got while
/// they were timed: threads that wait spin, so that other processes had the missing share, and the ratio is
/// then less than the machine can give. A note says so below 95 %, and where there is one core only. Call it before the
/// process is bound to a core.
void two_threads(const ThreadsOptions& options, const LockPatience& patience, TableSet& tables, Progress& progress);

}  // namespace crosscheck
