// Long runs: a million steps, a stiff cloth for a minute, and the ledger on the shipped scenes.

#include "mysim/implicit/newton.h"
#include "mysim/run/observers.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Largest deviation of the energy in the last tenth of the run, divided by that in the first tenth.
double late_over_early(const Stepper& s, double h, long steps) {
  const Scene scene = without_drag(shipped_scene("chain"));
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
    // Implicit steps cost about fifty times as much, so these rules run fewer of them. Their first tenth must still
    // exceed the 20 s after which the chain swings irregularly and fast.
    // A drift would make the last tenth ten times worse than the first. A bounded error varies by up to a factor of
    // two, because it is largest in the fastest moments of irregular swings.
    EXPECT_LT(late_over_early(s, 1e-3, s.evaluations > 0 ? 1000000 : 300000), 3) << s.name;
  }
}

TEST(AMillionSteps, RulesThatAreNotSymplecticDrift) {
  // in each step, rk4 damps (h omega)^6 / 72 of the energy of the fastest vibrations (h omega = 0.2), and thus
  // eventually all of it
  EXPECT_GT(late_over_early(stepper("rk4"), 1e-3, 1000000), 3);
}

using namespace testing_tools;

TEST(ImplicitEulerForAMinute, DescendsInEveryStepOfAStiffClothAndStaysBounded) {
  const Scene scene = small_scene(std::string("[grid]\nsize = [10, 10]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\n"
                                              "v = [0, 0, 1]\nmass = 0.25\n[grid.stiffness]\nstructural = 2e5\n"
                                              "shear = 2e5\nbend = 2e5\n[pins]\nparticles = [0, 9]\n"
                                              "[drag]\ngamma = 4\n") +
                                  gravity_text);
  const double h = 1.0 / 60;  // s; explicit rules need h < 8e-5 s
  System f(scene.model);
  ImplicitStep step(f);
  DivergenceMonitor monitor(scene.model);
  State s = scene.start;
  monitor.observe(s, true);
  long newton_steps = 0;
  int most = 0;
  double highest_rise = 0;
  for (int n = 1; n <= 3600; ++n) {
    ASSERT_NO_THROW(s = step.solve(s, h)) << n;
    s.t = n * h;
    scene.model.particles.place_pins(s);
    const std::vector<double>& values = step.descent();
    // two values differ by the rounding of both
    const double rounding = 2 * step.potential().rounding();
    for (size_t i = 1; i < values.size(); ++i) {
      highest_rise = std::max(highest_rise, (values[i] - values[i - 1]) / rounding);
      ASSERT_LE(values[i], values[i - 1] + rounding) << "step " << n;
    }
    newton_steps += static_cast<long>(values.size()) - 1;
    most = std::max(most, static_cast<int>(values.size()) - 1);
    ASSERT_EQ(monitor.observe(s, true), Verdict::ok) << n;
    // The cloth stays within its diagonal (1.4 m) from its pins, up to the stretch of its springs: m g / k = 1e-5 m.
    ASSERT_LT(s.x.colwise().norm().maxCoeff(), 2);
  }
  fmt::print("stiff cloth: {:.1f} Newton steps a step, {} at most, {} evaluations, highest rise {:.2g} roundings\n",
             double(newton_steps) / 3600, most, f.evaluations(), highest_rise);
}

using namespace testing_tools;

TEST(LedgerOfShippedScenes, ClosesToTheOrderOfTheStepperWithoutContact) {
  for (const auto name : {"pendulum", "chain", "cloth-swing", "cloth-wind"}) {
    const Scene scene = shipped_scene(name);
    for (const Stepper& s : fixed_steppers()) {
      // Explicit Euler would need steps of microseconds on these scenes. On a cloth, the other non-symplectic rules
      // damp the fastest waves by h^(order + 1), which hides the order at these steps; energy_test.cpp tests them on a
      // small cloth.
      const bool cloth = !scene.triangles.empty();
      if (!s.symplectic && (s.order == 1 || cloth)) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      // at a quarter of the scene's step, higher-order rules would be at round-off
      const double h = scene.step * (s.order < 4 ? 0.25 : cloth ? 1 : 2);
      const double order = slope(imbalance(s, scene, {h, 1, 20}), imbalance(s, scene, {h / 2, 1, 20}));
      fmt::print("{:12} {:18} order of the balance {:.2f}\n", name, s.name, order);
      // The next error term is smaller by a factor of less than 0.1 up to order 2 (h omega; on cloth, 0.2 squared), and
      // of 0.4 squared at higher orders. There, the ledger's integrals, of order 4, may dominate.
      EXPECT_GT(order, std::min(s.order, 4) - (s.order < 4 ? 0.1 : 0.25));
      EXPECT_LT(order, s.order + (s.order < 4 ? 0.1 : 0.25));
    }
  }
}

TEST(LedgerOfShippedScenes, ClosesToFirstOrderWithContact) {
  const Scene scene = shipped_scene("cloth-sphere");
  for (const Stepper& s : steppers()) {
    if (s.order == 1 && s.first_order) continue;  // explicit Euler blows up at these steps
    if (s.evaluations == 0) continue;             // implicit rules would take minutes; see contact_test.cpp
    SCOPED_TRACE(s.name);
    std::vector<double> errors;
    for (const double part : {1, 2, 4, 8}) errors.push_back(imbalance(s, scene, {scene.step / part, 1, 50}));
    fmt::print("cloth-sphere {:16} {:.3g} J, halved thrice {:.3g} J\n", s.name, errors[0], errors[3]);
    for (int i = 1; i < 4; ++i) EXPECT_LT(errors[i], errors[i - 1]);
    if (s.hard_constraints) continue;  // one Gauss-Seidel pass per step has order 1 only at smaller steps (0.67 here)
    // At each step size the 900 particles land at different fractions of a step. The spread of their mean is a few per
    // cent, which changes the order by 0.1. The explicit trapezoidal rule, near its stability limit at the largest
    // step, converges last.
    // Contact loss is an impulse times a mean velocity. First-order rules contribute their own error. The others
    // contribute, besides their own, an error of the contact positions, of an order between one and two.
    const double order = slope(errors[2], errors[3]);
    EXPECT_GT(order, 0.8);
    EXPECT_LT(order, s.order == 1 ? 1.2 : 2.2);
  }
}

}  // namespace
}  // namespace crosscheck
