// What the same accuracy costs: mysim beside Bullet and the integrators of others, on a sheet.
#pragma once

#include "experiments/bench/sheet_runs.h"
#include "experiments/bench/turns.h"
#include "experiments/point.h"

namespace crosscheck {

struct EqualErrorAsked {
  std::shared_ptr<const Scene> scene;
  std::vector<Peer> peers;
  TurnPlan turns;
};

/// How many steps of work are announced.
int work_of(const EqualErrorAsked& asked);

/// `bench-equal-error-cost`: for each run of each peer its error (sheet_runs.h), its time, and how many times that is
/// the time of mysim's cheapest run that errs no more (the truth's bar counted against mysim on both sides), round by
/// round: once with the best instructions that the machine has, once with SSE2 alone. No ratio stands where the peer's
/// error is within the bar. `bench-own-runs-cost`: mysim's runs.
void equal_error(const EqualErrorAsked& asked, Rows& rows, Progress& progress);

}  // namespace crosscheck
