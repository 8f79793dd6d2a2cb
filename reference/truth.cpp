// Finds the truth of a scene.
#include "reference/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/engine.h"
#include "mysim/observers/watch.h"
#include "reference/exact/exact.h"

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

  const Stepper& rk4 = stepper_named("rk4");
  Recorder coarse, fine;
  // the scene's own step, whatever the run's: truth must not depend on what is compared with it
  Watch coarse_watch(scene.model), fine_watch(scene.model);
  Observers coarse_look({&coarse, &coarse_watch}), fine_look({&fine, &fine_watch});
  const Outcome a =
      simulate(rk4, ContactRule::coulomb, scene, {scene.step / 2, run.duration, run.samples}, coarse_look);
  const Outcome b = simulate(rk4, ContactRule::coulomb, scene, {scene.step / 4, run.duration, run.samples}, fine_look);
  if (a.verdict != Verdict::ok || b.verdict != Verdict::ok) return std::nullopt;
  double bar = 0, motion = 0;
  for (int i = 0; i < fine.trajectory.frames(); ++i) {
    motion = std::max(motion, rms_distance(fine.trajectory.x[i], fine.trajectory.x[0]));
    bar = std::max(bar, rms_distance(coarse.trajectory.x[i], fine.trajectory.x[i]));
  }
  bar = std::max(bar, 1e-15 * scene.size());
  if (!(bar < 0.01 * motion)) return std::nullopt;  // known to less than a hundredth of the motion: not known
  return Truth{Tier::converged,
               fmt::format("rk4 at {:.3g} s, one route (no independent integrator yet)", scene.step / 4),
               std::move(fine.trajectory), bar};
}

}  // namespace crosscheck
