// A million steps: symplectic rules keep the error of the energy bounded, others drift.
#include "experiments/scenes.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Largest deviation of the energy in the last tenth of the run over that in the first.
double late_over_early(const Stepper& s, double h, long steps) {
  const Scene scene = without_drag(load_scene("chain"));
  const int samples = static_cast<int>(std::min(steps, 100000l));
  const Trajectory t = trajectory_of(s, scene, {h, h * static_cast<double>(steps), samples});
  auto energy = [&](int i) { return energy_of(scene.model, {t.t[i], t.x[i], t.v[i]}).total(); };
  double early = 0, late = 0;
  for (int i = 0; i < t.frames(); ++i) {
    const double error = std::abs(energy(i) - energy(0));
    if (i <= samples / 10) early = std::max(early, error);
    if (i >= samples - samples / 10) late = std::max(late, error);
  }
  EXPECT_GT(early, 0);
  fmt::print("{:18} {} steps: energy error {:.3g} J early, {:.3g} J late\n", s.name, steps, early, late);
  return late / early;
}

TEST(AMillionSteps, SymplecticRulesKeepTheEnergyBounded) {
  for (const Stepper& s : steppers()) {
    if (!s.symplectic) continue;
    // implicit rules cost some fifty times as much a step; the first tenth must still be longer than the 20 s in which
    // the chain's swings become irregular and fast
    // a drift would make the last tenth ten times worse than the first; a bounded error repeats itself, but the chain
    // swings irregularly and its fastest moment, which makes the error, is met to within a factor of two
    EXPECT_LT(late_over_early(s, 1e-3, s.evaluations > 0 ? 1000000 : 300000), 3) << s.name;
  }
}

TEST(AMillionSteps, RulesThatAreNotSymplecticDrift) {
  // rk4 takes (h omega)^6 / 72 of the fastest vibrations' energy in each step (h omega = 0.2): all of it in the end
  EXPECT_GT(late_over_early(stepper("rk4"), 1e-3, 1000000), 3);
}

}  // namespace
}  // namespace crosscheck
