// mysim's implicit step beside a sparse factorisation: the same linear system, solved to round-off by both.
#pragma once

#include <vector>

#include "experiments/bench/micro.h"
#include "experiments/point.h"
#include "mysim/progress.h"

namespace crosscheck {

struct ImplicitStepAsked {
  std::vector<int> sides;     // particles along a side of the sheet
  std::vector<double> rates;  // steps a second
  MicroPlan plan;
};

/// How many are announced.
inline int work_of(const ImplicitStepAsked& asked) { return static_cast<int>(asked.sides.size() * asked.rates.size()); }

/// `bench-implicit-step-cost`: from the sheet as it hangs after half a second, one step of `implicit-euler+linear` and
/// one by Eigen's SimplicialLDLT (factorised_step.h): how far apart both end (the farthest particle, m), their times,
/// iterations of conjugate gradients, and the ratio of the times, round by round; with the best instructions for mysim,
/// and with SSE2 alone.
void implicit_step(const ImplicitStepAsked& asked, Rows& rows, Progress& progress);

}  // namespace crosscheck
