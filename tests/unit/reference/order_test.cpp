// Orders of all steppers, with bounds on both sides, and error control: errors follow the tolerance.

#include "reference/truth/exact/exact.h"
#include "tests/unit/helpers.h"
#include "tests/unit/mysim/declared.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Orders, OnCircleAgainstTheExactSolution) {
  const Scene scene = shipped_scene("circle");
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  const crosscheck::Run run{0, 6, 40};
  Trajectory truth;
  for (int i = 0; i <= run.samples; ++i) {
    const State s = exact->at(run.duration * i / run.samples);
    truth.t.push_back(s.t), truth.x.push_back(s.x), truth.v.push_back(s.v);
  }
  for (const Stepper& s : fixed_steppers()) {
    if (!s.first_order) continue;
    SCOPED_TRACE(s.name);
    // The next error term changes the slope by about h omega, here at most 0.04.
    const double h = s.order == 1 ? 0.002 : s.order == 2 ? 0.02 : 0.1;
    EXPECT_NEAR(measured_order(s, scene, truth, h, run), s.order, 0.1);
  }
}

TEST(Orders, OnPendulumPlainDampedAndMovedByHand) {
  const Scene plain = shipped_scene("pendulum");
  Scene moved = with_drag(plain, 1);
  moved.model.particles.move = Motion{{0.1, 0.05, 0}, 1, 0.4};
  const double omega = std::sqrt(1000.0);
  const crosscheck::Run run{0, 1, 20};
  const struct {
    std::string name;
    Scene scene;
  } cases[] = {{"plain", plain}, {"drag", with_drag(plain, 2)}, {"moved pin and drag", moved}};
  for (const auto& c : cases) {
    const Trajectory truth = trajectory_of(stepper("rk4"), c.scene, {0.005 / omega, run.duration, run.samples});
    for (const Stepper& s : fixed_steppers()) {
      SCOPED_TRACE(c.name + ", " + std::string(s.name));
      ASSERT_LT(h_omega_for(s.order), 0.6);  // above 0.6, rk4 does not show its order (2.8 to 3.2 at 1.2)
      // The next error term is smaller by h omega (at most 0.3, which changes the slope by half of that). Amplitude
      // growth (h omega^2 t / 2) changes order 1 by 0.05.
      const double order = measured_order(s, c.scene, truth, h_omega_for(s.order) / omega, run);
      fmt::print("pendulum, {:18} {:18} order {:.3f}\n", c.name, s.name, order);
      EXPECT_NEAR(order, s.order, s.order > 4 ? 0.2 : 0.1);
    }
  }
}

TEST(Orders, SurviveDashpotsAirAndPinsMovedByHand) {
  const Scene scene = small_cloth_in_air();
  const crosscheck::Run run{0, 0.25, 5};  // the end of the ramp, where the motion's third derivative jumps
  const Trajectory truth = trajectory_of(stepper("rk4"), scene, {6.25e-5, run.duration, run.samples});
  for (const Stepper& s : fixed_steppers()) {
    SCOPED_TRACE(s.name);
    // h omega of the cloth's fastest wave (180 rad/s): 0.02, 0.05 and 0.2
    const double h = s.order == 1 ? 1e-4 : s.order == 2 ? 2.5e-4 : 1.25e-3;
    const double order = measured_order(s, scene, truth, h, run);
    fmt::print("cloth in air, {:18} order {:.3f}\n", s.name, order);
    EXPECT_NEAR(order, s.order, 0.25);  // the next term is smaller by h omega
  }
}

using namespace testing_tools;

std::vector<Stepper> adaptive_steppers() {
  std::vector<Stepper> list;
  for (const Stepper& s : steppers())
    if (s.adaptive) list.push_back(s);
  EXPECT_FALSE(list.empty());
  return list;
}

TEST(Adaptive, ErrorFollowsTheToleranceOverSixDecades) {
  for (const auto name : {"pendulum", "chain"}) {
    const Scene scene = with_drag(without_drag(shipped_scene(name)), 1);
    const int samples = 20;
    // The truth has at least 1700 steps per period of the fastest spring. Per radian, it errs by (2 pi / 1700)^4 / 120
    // of a vibration of 0.01 m: by 3e-12 m in 180 radians.
    const Trajectory truth = trajectory_of(stepper("rk4"), scene, {2e-5, 1, samples});
    for (const Stepper& s : adaptive_steppers()) {
      double before = INFINITY, first = 0, last = 0;
      for (int decade = 4; decade <= 10; ++decade) {
        const double tolerance = std::pow(10, -decade);
        Recorder r;
        const Outcome out = simulate(s, ContactRule::coulomb, scene, {1e-3, 1, samples, tolerance}, r);
        const double error = sup_rms(r.trajectory, truth);
        fmt::print("{:9} {} tolerance {:.0e} error {:.2e} m, mean step {:.2e} s\n", name, s.name, tolerance, error,
                   out.step);
        EXPECT_LT(error, 10 * tolerance * scene.size());  // a second is about ten periods of the slow motion
        EXPECT_LT(error, before) << tolerance;
        before = error;
        if (decade == 5) first = error;
        last = error;
      }
      // Errors of the tolerance R per step accumulate to between R^(p/(p+1)) and R: an exponent of 0.83 to 1 for p = 5.
      // The fit starts at 1e-5: at 1e-4 the chain's steps are at the edge of stability (mean h omega = 2), where the
      // error stays at the tolerance.
      const double decades = std::log10(first / last) / 5;
      EXPECT_GT(decades, 0.7) << name;
      EXPECT_LT(decades, 1.3) << name;
    }
  }
}

TEST(Adaptive, StatesBetweenStepsAreAsGoodAsAtTheirEnds) {
  const Scene scene = shipped_scene("chain");
  for (const Stepper& s : adaptive_steppers())
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      double error[2];
      for (const int many : {0, 1}) {
        const int samples = many ? 200 : 20;
        const Trajectory truth = trajectory_of(stepper("rk4"), scene, {5e-5, 1, samples});
        error[many] = sup_rms(trajectory_of(s, scene, {1e-3, 1, samples, tolerance}), truth);
      }
      // The interpolant's error is one order lower than the step's, with a small constant.
      EXPECT_LT(error[1], 3 * error[0]) << tolerance;
    }
}

TEST(Adaptive, SamplesDoNotChangeTheSteps) {
  const Scene scene = shipped_scene("chain");
  for (const Stepper& s : adaptive_steppers()) {
    Recorder few, many;
    const Outcome a = simulate(s, ContactRule::coulomb, scene, {1e-3, 1, 10, 1e-6}, few);
    const Outcome b = simulate(s, ContactRule::coulomb, scene, {1e-3, 1, 1000, 1e-6}, many);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(a.steps, b.steps);
    // identical polynomials at identical times, up to the rounding of the time
    EXPECT_LT((few.trajectory.x.back() - many.trajectory.x.back()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Adaptive, ARunTellsItsToleranceStepsAndMeanStep) {
  const Scene scene = shipped_scene("pendulum");
  for (const Stepper& s : adaptive_steppers()) {
    long before = 0;
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
      Recorder r;
      const Outcome out = simulate(s, ContactRule::coulomb, scene, {1e-3, 2, 10, tolerance}, r);
      EXPECT_EQ(out.verdict, Verdict::ok);
      EXPECT_EQ(out.tolerance, tolerance);
      EXPECT_DOUBLE_EQ(out.end, 2);
      EXPECT_DOUBLE_EQ(out.step, 2.0 / static_cast<double>(out.steps));
      EXPECT_GT(out.steps, before);
      EXPECT_GE(out.evaluations, s.evaluations * out.steps + 1);  // plus those of rejected steps
      EXPECT_LT(out.evaluations, 2 * s.evaluations * out.steps + 60);
      before = out.steps;
    }
  }
  Recorder r;
  EXPECT_EQ(simulate(stepper("rk4"), ContactRule::coulomb, scene, {1e-3, 1, 10, 1e-4}, r).tolerance, 0);
}

TEST(Adaptive, StepsGrowWithTheFifthRootOfTheTolerance) {
  const Scene scene = shipped_scene("pendulum");
  for (const Stepper& s : adaptive_steppers()) {
    auto steps = [&](double tolerance) {
      Recorder r;
      return double(simulate(s, ContactRule::coulomb, scene, {1e-3, 4, 10, tolerance}, r).steps);
    };
    // The estimate of a step is of order h^5, so a tolerance lower by 1e5 needs ten times as many steps. Swings mix
    // slow and fast parts.
    EXPECT_NEAR(std::log10(steps(1e-10) / steps(1e-5)), 1, 0.15);
  }
}

TEST(Adaptive, AStepBelowRoundOffIsASolverFailureAndARow) {
  // a force for which no step is short enough
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [2, 0, 0]\nmass = 1\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 1e300\nrest = 1\n[pins]\nparticles = [0]\n");
  for (const Stepper& s : adaptive_steppers()) {
    const MethodRun a = run_and_record("mysim/" + std::string(s.name), scene, {1e-3, 1, 10});
    EXPECT_EQ(a.outcome.verdict, Verdict::solver);
    EXPECT_TRUE(contains(a.outcome.reason, "the step fell below round-off at t = "));
    EXPECT_EQ(a.outcome.end, 0);
  }
}

TEST(Adaptive, BesideASphereNoStepIsLongerThanTheRunsStep) {
  const std::string ball = "[[particle]]\nposition = [0.3, 1.2, 0]\nmass = 1\n" + std::string(gravity_text);
  const Scene free = small_scene(ball),
              onto = small_scene(ball + "[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = 0.3\n");
  for (const Stepper& s : adaptive_steppers())
    for (const double step : {1e-2, 1e-3}) {
      Recorder r;
      EXPECT_LT(simulate(s, ContactRule::coulomb, free, {step, 1, 10}, r).steps, 20);  // a parabola
      const Outcome out = simulate(s, ContactRule::coulomb, onto, {step, 1, 10}, r);
      EXPECT_EQ(out.verdict, Verdict::ok);
      EXPECT_LE(out.step, step * (1 + 1e-9));
      EXPECT_GE(out.steps, std::lround(1 / step));
    }
}

TEST(Adaptive, EveryContactOnTheWayToAStateIsInTheLedger) {
  // Two particles on a stiff spring slide down a ball. One step of the run has many internal steps, each with contact.
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0.1, 1.05, 0]\nmass = 1\n[[particle]]\nposition = [0.3, 1.05, 0]\nmass = 1\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 4000\nrest = 0.2\n" +
      std::string(gravity_text) + "[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = 0.3\n");
  for (const Stepper& s : adaptive_steppers())
    for (const double tolerance : {1e-6, 1e-8}) {
      Ledger ledger(scene.model, ContactLoss::reported);
      crosscheck::Run run{0.02, 1, 50};
      run.tolerance = tolerance;
      const Outcome out = simulate(s, ContactRule::coulomb, scene, run, ledger);
      ASSERT_EQ(out.verdict, Verdict::ok);
      ASSERT_GT(out.steps, 3 * 50) << "expected several internal steps per step of the run";
      const auto& rows = ledger.rows();
      ASSERT_GT(rows.back().contact, 0.1) << "friction must dissipate energy";
      // Without other losses, the imbalance is the error of a few hundred steps, plus the error of the contact rule.
      // Each step's error is below the tolerance times the 20 J that the fall converts.
      // In each step the contact rule moves a particle back by a h^2 / 2, where a = g cos theta - v^2 / R presses it
      // onto the ball, and takes the energy m (a h)^2 / 2. This energy is too little by m h^2 a (v^2 / R) / 2. On the
      // way down from rest, the product of `a` and v^2 / R is at most g^2 / 6, so for two kilograms g^2 h / 6 is
      // missing after a second.
      const double rule = 9.81 * 9.81 / 6 * out.step;
      fmt::print("{} tolerance {:.0e}: contact took {:.4g} J, open {:.2g} J, the rule's {:.2g} J\n", s.name, tolerance,
                 rows.back().contact, rows.back().balance() - rows.front().balance(), rule);
      for (const LedgerRow& row : rows)
        EXPECT_NEAR(row.balance(), rows.front().balance(), 20 * static_cast<double>(out.steps) * tolerance + rule)
            << row.t;
    }
}

}  // namespace
}  // namespace crosscheck
