// Bullet's explicit world beside mysim's symplectic Euler at the same step: the same rule, so that the time of a step
// is all that differs.
#pragma once

#include "experiments/bench/turns.h"
#include "experiments/point.h"
#include "mysim/progress.h"

namespace crosscheck {

struct SameStepAsked {
  int side = 64;          // particles along a side of the sheet
  double duration = 0.2;  // s, over which both are followed
  TurnPlan turns;
};

/// `bench-same-step-cost`: on a sheet whose three stiffnesses a force class of our own carries in Bullet (without
/// faces), and on one of two stiffnesses under Bullet's own spring force: how far apart both engines are at the end
/// (the farthest particle, m), the time of a step, and the ratio of the times, round by round; with the best
/// instructions for mysim, and with SSE2 alone.
void same_step(const SameStepAsked& asked, Rows& rows, Progress& progress);

}  // namespace crosscheck
