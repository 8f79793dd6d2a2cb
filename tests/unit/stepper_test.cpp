// Steppers: the table, what each row declares, growth per step against its formula, determinism, counts.
#include <complex>

#include "mysim/errors.h"
#include "reference/exact/exact.h"
#include "tests/unit/declared.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Steppers, TableIsSane) {
  EXPECT_GE(steppers().size(), 10u);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    EXPECT_GE(s.order, 1);
    // explicit rules count theirs; the others take what their equations need
    EXPECT_GE(s.evaluations, 0);
    EXPECT_TRUE(s.step);
    ASSERT_TRUE(s.limit);
    EXPECT_GE(s.limit(10, 0), 0);
    EXPECT_FALSE(s.what.empty());
    EXPECT_FALSE(s.limit_formula.empty());
    EXPECT_EQ(std::count_if(steppers().begin(), steppers().end(), [&](const Stepper& t) { return t.name == s.name; }),
              1);
  }
}

/// Factor by which one step changes the radius on `circle`, where a formula is known.
double growth_on_circle(std::string_view name, double h) {
  if (name == "explicit-euler") return std::sqrt(1 + h * h);
  if (name == "trapezoidal") return std::sqrt(1 + h * h * h * h / 4);
  const double terms[] = {1, 1, 1. / 2, 1. / 6, 1. / 24, 1. / 120, 1. / 600};  // of the rules' polynomials in i h
  const int known = name == "rk4" ? 5 : name == "dopri5" ? 7 : 0;
  std::complex<double> sum = known ? 0 : NAN, power = 1;
  for (int i = 0; i < known; ++i, power *= std::complex<double>(0, h)) sum += terms[i] * power;
  return std::abs(sum);
}

TEST(Steppers, GrowthPerStepOnCircleIsTheFormula) {
  const Scene scene = load_scene("circle");
  for (const Stepper& s : fixed_steppers())
    for (const double h : {0.01, 0.05, 0.3, 1.0}) {
      if (!s.first_order) continue;
      SCOPED_TRACE(fmt::format("{} h = {}", s.name, h));
      const double growth = growth_on_circle(s.name, h);
      ASSERT_TRUE(std::isfinite(growth)) << "a new first-order stepper needs its formula here";
      const int steps = 100;
      const Trajectory t = trajectory_of(s, scene, {h, steps * h, steps});
      for (int i = 0; i < steps; ++i)
        // each stage rounds a few times, by half an ulp of numbers of the size of the radius
        EXPECT_NEAR(t.x[i + 1].norm() / t.x[i].norm(), growth, (8 + 4 * s.evaluations) * eps * growth);
    }
}

TEST(Steppers, LeapfrogIsItsOwnInverseUnderDrag) {
  const Scene scene = small_cloth();
  System f(scene.model);
  State s = scene.start;
  Workspace w(s);
  const double h = 1e-3;
  for (int i = 0; i < 50; ++i) leapfrog(f, s, h, w), s.t = (i + 1) * h, scene.model.particles.place_pins(s);
  for (int i = 50; i > 0; --i) leapfrog(f, s, -h, w), s.t = (i - 1) * h, scene.model.particles.place_pins(s);
  // a hundred steps of a few ulps of a scene of 1 m, with velocities of some m/s over h
  EXPECT_LT((s.x - scene.start.x).cwiseAbs().maxCoeff(), 1e3 * eps);
}

TEST(Steppers, TwoRunsAreBitEqual) {
  for (const auto name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    for (const Stepper& s : steppers()) {
      if (!takes(s, scene)) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      const crosscheck::Run run{scene.step, 0.05, 5};
      EXPECT_TRUE(identical(trajectory_of(s, scene, run), trajectory_of(s, scene, run)));
    }
  }
}

TEST(Steppers, EvaluationsAndStepsAreCounted) {
  for (const auto name : {"circle", "pendulum"})
    for (const Stepper& s : fixed_steppers()) {
      const Scene scene = load_scene(name);
      if (!takes(s, scene)) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      Recorder r;
      const Outcome out = simulate(s, ContactRule::coulomb, scene, {0.01, 0.5, 10}, r);
      EXPECT_EQ(out.steps, 50);
      if (s.evaluations > 0)
        // a rule that hands its last stage on does not know it at a fixed step's start: one more evaluation
        EXPECT_EQ(out.evaluations, 50 * (s.evaluations + stepper(s.name).adaptive));
      else
        EXPECT_GE(out.evaluations, 2 * 50);  // the force at the start of the solve and at its end
      EXPECT_EQ(r.trajectory.frames(), 11);
      EXPECT_DOUBLE_EQ(out.end, 0.5);
    }
}

TEST(Steppers, FirstOrderScenesAreRefusedByRulesThatNeedVelocities) {
  const Scene scene = load_scene("circle");
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    Recorder r;
    if (s.first_order)
      EXPECT_NO_THROW(simulate(s, ContactRule::coulomb, scene, default_run(scene), r));
    else
      EXPECT_THROW(simulate(s, ContactRule::coulomb, scene, default_run(scene), r), Unsupported);
  }
}

TEST(StepPlan, DividesTheSamplingIntervalAndIsNeverLongerThanAsked) {
  for (const double step : {1e-3, 3e-4, 0.0123, 0.5, 7.0})
    for (const int samples : {1, 7, 150}) {
      const StepPlan p = plan({step, 3, samples});
      EXPECT_LE(p.h, std::min(step, 3.0 / samples) * (1 + 1e-9));  // a step is kept when only round-off divides them
      EXPECT_NEAR(p.h * p.steps_per_sample * p.samples, 3, 4 * eps * 3);
    }
}

TEST(StepPlan, RefusesMoreStepsThanCanBeCounted) {
  // 5e13 steps between two samples: a wrapped count would silently run one step of a whole sampling interval
  EXPECT_THROW(plan({1e-13, 5, 1}), InputError);
  EXPECT_THROW(plan({1e-300, 5, 250}), InputError);
}

}  // namespace
}  // namespace crosscheck
