// Finds the truth of a scene.
#include "reference/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/engine.h"
#include "mysim/errors.h"
#include "mysim/frequency.h"
#include "mysim/observers/watch.h"
#include "reference/exact/exact.h"
#include "reference/multipliers.h"

namespace crosscheck {
namespace {

const Stepper& stepper_named(std::string_view name) {
  const auto all = steppers();
  return *std::find_if(all.begin(), all.end(), [&](const Stepper& s) { return s.name == name; });
}

Truth from_closed_form(const ExactSolution& exact, const Scene& scene, const Run& run) {
  const StepPlan steps = plan(run);
  Truth truth{Tier::exact, "closed form: " + exact.formula, {}, 0};
  double path = 0;
  for (int sample = 0; sample <= steps.samples; ++sample) {
    const State s = exact.at(steps.time(sample, 0));
    if (sample > 0) path += (s.x - truth.trajectory.x.back()).norm();
    truth.trajectory.t.push_back(s.t);
    truth.trajectory.x.push_back(s.x);
    truth.trajectory.v.push_back(s.v);
  }
  // an angle of many radians is known to eps times itself only: the round-off grows with the path
  truth.bar = 1e-15 * (scene.size() + path);
  return truth;
}

/// rk4 under a watch for failures; with hard distances on accelerations that keep them.
Outcome by_rk4(const Scene& scene, const Run& run, bool hard, Recorder& recorder) {
  Watch watch(scene.model);
  Observers look({&recorder, &watch});
  if (!hard) return simulate(stepper_named("rk4"), ContactRule::coulomb, scene, run, look);
  try {
    MultiplierWorld world(scene, plan(run).h);
    return march(world, run, look);
  } catch (const Unsupported&) {
    Outcome none;
    none.verdict = Verdict::unsupported;
    return none;
  }
}

}  // namespace

std::string_view name_of(Tier tier) {
  switch (tier) {
    case Tier::exact:
      return "exact";
    case Tier::exact_discrete:
      return "exact for the discrete rule";
    case Tier::converged:
      return "converged";
    case Tier::another_engine:
      return "another engine";
  }
  return "unknown";
}

double rms_distance(const Points& a, const Points& b) { return (a - b).norm() / std::sqrt(double(a.cols())); }

std::optional<Truth> truth_of(const Scene& scene, const Run& run) {
  if (const auto exact = exact_solution(scene)) return from_closed_form(*exact, scene, run);
  if (scene.model.find<Spheres>()) return std::nullopt;

  // steps of the scene's own, whatever the run's: truth must not depend on what is compared with it
  const bool hard = scene.model.find<Constraints>() != nullptr;
  // rk4 follows a vibration well below h omega = 0.7 and is stable up to 2.83: the coarse route is at most at 1.4
  const double omega = fastest_frequency(scene.model, scene.start);
  // a few particles cost little: there the bar is pushed down to where order can be seen
  const double part = scene.model.particles.size() < 50 && !hard ? 16 : 4;
  const double step = std::min(scene.step / part, omega > 0 ? 0.7 / omega : scene.step);
  Recorder coarse, fine;
  const Outcome a = by_rk4(scene, {2 * step, run.duration, run.samples}, hard, coarse);
  const Outcome b = by_rk4(scene, {step, run.duration, run.samples}, hard, fine);
  if (a.verdict != Verdict::ok || b.verdict != Verdict::ok) return std::nullopt;
  double bar = 0, motion = 0;
  for (int i = 0; i < fine.trajectory.frames(); ++i) {
    motion = std::max(motion, rms_distance(fine.trajectory.x[i], fine.trajectory.x[0]));
    bar = std::max(bar, rms_distance(coarse.trajectory.x[i], fine.trajectory.x[i]));
  }
  bar = std::max(bar, 1e-15 * scene.size());
  if (!(bar < 0.01 * motion)) return std::nullopt;  // known to less than a hundredth of the motion: not known
  return Truth{Tier::converged,
               fmt::format("rk4 at {:.3g} s{}, one route (no independent integrator yet)", step,
                           hard ? " with Lagrange multipliers for the hard distances" : ""),
               std::move(fine.trajectory), bar};
}

}  // namespace crosscheck
