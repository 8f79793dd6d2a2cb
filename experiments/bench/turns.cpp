#include "experiments/bench/turns.h"

#include <algorithm>
#include <cmath>

#include "experiments/sweep/machine_lock.h"
#include "experiments/timing.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

class Nobody : public Observer {
 public:
  Verdict observe(const State&, bool) override { return Verdict::ok; }
};

/// The first part of a run, in one piece: a look in between would cost as much as a few steps of a small scene.
Run part_of(const Turn& turn, double share) {
  Run part = turn.run;
  part.samples = 1;
  if (turn.method.adaptive) {
    part.duration = share * turn.run.duration;
    return part;
  }
  const StepPlan whole = plan(turn.run);
  const auto all = static_cast<double>(whole.steps_per_sample) * whole.samples;
  part.step = whole.h;
  part.duration = whole.h * std::clamp(std::round(share * all), 1., all);
  return part;
}

Outcome outcome_of(const Turn& turn, double share) {
  std::optional<Instructions> kept;
  if (turn.instructions) kept.emplace(*turn.instructions);
  Nobody nobody;
  try {
    return turn.method.engine(*turn.scene, part_of(turn, share), nobody);
  } catch (const Unsupported&) {
    return {};
  }
}

/// As much of the run as takes so long.
double share_to_time(const Turn& turn, double seconds) {
  double share = 1. / 256;
  while (share < 1) {
    const double taken = outcome_of(turn, share).cpu_seconds;
    if (!(taken < seconds)) break;
    share = std::min(1., share * std::clamp(1.2 * seconds / std::max(taken, 1e-9), 2., 64.));
  }
  return share;
}

}  // namespace

std::vector<TurnTimes> timed_in_turns(const std::vector<Turn>& turns, const TurnPlan& plan) {
  const MachineLock alone(MachineLock::Hold::alone);
  std::vector<TurnTimes> all(turns.size());
  std::vector<std::function<double()>> runs;
  for (size_t i = 0; i < turns.size(); ++i) {
    all[i].share = share_to_time(turns[i], plan.seconds);
    runs.push_back([&turn = turns[i], share = all[i].share] {
      const Outcome out = outcome_of(turn, share);
      return out.evaluations > 0 ? out.cpu_seconds / static_cast<double>(out.evaluations) : 0;
    });
  }
  // what a run says is the time of an evaluation and not its own: it is long enough as it is
  const auto times =
      timed_in_turns(runs, TimingPlan{.least = plan.rounds, .most = plan.rounds, .resolution = 0, .warm = INFINITY});
  for (size_t i = 0; i < turns.size(); ++i)
    if (times[i] != std::vector<double>{0}) all[i].per_evaluation = times[i];
  return all;
}

}  // namespace crosscheck
