// Steppers: measured orders, growth per step against its formula, stability on both sides of the limit, determinism.
#include <complex>

#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/observers/watch.h"
#include "reference/exact/exact.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// h omega of the coarser step: small enough for the leading error term, large enough to stay above round-off.
double h_omega_for(int order) { return order == 1 ? 0.002 : order == 2 ? 0.04 : 0.3; }

/// Measures the order of a stepper between a step of at most h and half of it, by the largest RMS error over time.
double measured_order(const Stepper& s, const Scene& scene, const Trajectory& truth, double h, const Run& run) {
  const double used = plan({h, run.duration, run.samples}).h;
  const double coarse = sup_rms(trajectory_of(s, scene, {used, run.duration, run.samples}), truth);
  const double fine = sup_rms(trajectory_of(s, scene, {used / 2, run.duration, run.samples}), truth);
  EXPECT_GT(fine, 1e-13) << "error at round-off: the slope would be noise";
  return slope(coarse, fine);
}

TEST(Steppers, TableIsSane) {
  EXPECT_GE(steppers().size(), 5u);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    EXPECT_GE(s.order, 1);
    EXPECT_GE(s.evaluations, 1);
    EXPECT_FALSE(s.what.empty());
    EXPECT_EQ(std::count_if(steppers().begin(), steppers().end(), [&](const Stepper& t) { return t.name == s.name; }),
              1);
  }
}

TEST(Steppers, OrderOnCircleAgainstTheExactSolution) {
  const Scene scene = load_scene("circle");
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  const crosscheck::Run run{0, 6, 40};
  Trajectory truth;
  for (int i = 0; i <= run.samples; ++i) {
    const State s = exact->at(run.duration * i / run.samples);
    truth.t.push_back(s.t), truth.x.push_back(s.x), truth.v.push_back(s.v);
  }
  for (const Stepper& s : steppers()) {
    if (!s.first_order) continue;
    SCOPED_TRACE(s.name);
    // the next term of the error changes the slope by about h omega: at most 0.04 here, 0.1 with room
    const double h = s.order == 1 ? 0.002 : s.order == 2 ? 0.02 : 0.1;
    EXPECT_NEAR(measured_order(s, scene, truth, h, run), s.order, 0.1);
  }
}

TEST(Steppers, OrderOnPendulumPlainDampedAndMovedByHand) {
  const Scene plain = load_scene("pendulum");
  Scene moved = with_drag(plain, 1);
  moved.model.particles.move = PinMotion{{0.1, 0.05, 0}, 1, 0.4};
  const double omega = std::sqrt(1000.0);
  const crosscheck::Run run{0, 1, 20};
  const struct {
    std::string name;
    Scene scene;
  } cases[] = {{"plain", plain}, {"drag", with_drag(plain, 2)}, {"moved pin and drag", moved}};
  for (const auto& c : cases) {
    const Trajectory truth = trajectory_of(stepper("rk4"), c.scene, {0.01 / omega, run.duration, run.samples});
    for (const Stepper& s : steppers()) {
      SCOPED_TRACE(c.name + ", " + std::string(s.name));
      ASSERT_LT(h_omega_for(s.order), 0.6);  // above it rk4 does not show its order (facts/scenes.md, section 4)
      // the next term of the error is smaller by h omega, and amplitude growth (h omega^2 t / 2) bends order 1 by 0.05
      EXPECT_NEAR(measured_order(s, c.scene, truth, h_omega_for(s.order) / omega, run), s.order, 0.1);
    }
  }
}

/// Factor by which one step changes the radius on `circle`, where a formula is known.
double growth_on_circle(std::string_view name, double h) {
  if (name == "explicit-euler") return std::sqrt(1 + h * h);
  if (name == "trapezoidal") return std::sqrt(1 + h * h * h * h / 4);
  if (name == "rk4") return std::abs(std::complex(1 - h * h / 2 + h * h * h * h / 24, h - h * h * h / 6));
  return NAN;
}

TEST(Steppers, GrowthPerStepOnCircleIsTheFormula) {
  const Scene scene = load_scene("circle");
  for (const Stepper& s : steppers())
    for (const double h : {0.01, 0.05, 0.3, 1.0}) {
      if (!s.first_order) continue;
      SCOPED_TRACE(fmt::format("{} h = {}", s.name, h));
      const double growth = growth_on_circle(s.name, h);
      ASSERT_TRUE(std::isfinite(growth)) << "a new first-order stepper needs its formula here";
      const int steps = 100;
      const Trajectory t = trajectory_of(s, scene, {h, steps * h, steps});
      for (int i = 0; i < steps; ++i)
        // each step rounds a dozen times, each by half an ulp of numbers of the size of the radius
        EXPECT_NEAR(t.x[i + 1].norm() / t.x[i].norm(), growth, 8 * eps * growth);
    }
}

/// `spring` without drag, let go near its hanging length so that it never reaches the anchor: exactly linear.
Scene linear_spring(double offset) {
  Scene scene = load_scene("spring");
  scene.start.x(1, 1) = -(1 + 9.81 / 100) - offset;
  return scene;
}
constexpr double spring_omega = 10;                  // rad/s
constexpr double hanging_length = 1 + 9.81 / 100.0;  // m

struct Stability {
  Verdict verdict;
  double largest;  // m, excursion from the hanging length
};

class Excursion : public Observer {
 public:
  Verdict observe(const State& state, bool) override {
    largest = std::max(largest, std::abs(-state.x(1, 1) - hanging_length));
    return Verdict::ok;
  }
  double largest = 0;
};

Stability try_out(const Stepper& s, const Scene& scene, double h_omega, int steps) {
  const double h = h_omega / spring_omega;
  Watch watch(scene.model);
  Excursion excursion;
  Observers both({&watch, &excursion});
  const Outcome out = simulate(s, ContactRule::coulomb, scene, {h, h * steps, steps}, both);
  return {out.verdict, excursion.largest};
}

TEST(Steppers, StabilityLimitHoldsBelowAndFailsAbove) {
  const double offset = 0.01;
  const struct {
    std::string_view name;
    double below, above;
  } limits[] = {{"symplectic-euler", 1.98, 2.02}, {"leapfrog", 1.98, 2.02}, {"rk4", 2.80, 2.86}};
  for (const auto& limit : limits) {
    SCOPED_TRACE(limit.name);
    const Stability below = try_out(stepper(limit.name), linear_spring(offset), limit.below, 100000);
    EXPECT_EQ(below.verdict, Verdict::ok);
    // both symplectic rules keep w^2 u^2 -+ h w^2 u v + v^2 (or better): |u| <= u0 / sqrt(1 - (h w / 2)^2); rk4 decays
    const double bound = limit.below < 2 ? offset / std::sqrt(1 - limit.below * limit.below / 4) : offset;
    EXPECT_LE(below.largest, bound * (1 + 1e-9));  // 1e5 steps of round-off
    const Stability above = try_out(stepper(limit.name), linear_spring(offset), limit.above, 100000);
    EXPECT_EQ(above.verdict, Verdict::energy);
  }
}

TEST(Steppers, UndampedRulesWithoutALimitFailAtEveryStep) {
  for (const double h_omega : {0.2, 0.5})
    for (const auto name : {"explicit-euler", "trapezoidal"}) {
      SCOPED_TRACE(fmt::format("{} h omega = {}", name, h_omega));
      // the slowest grows by (0.2)^4 / 8 = 2e-4 a step: 2e5 steps multiply the amplitude by e^40
      EXPECT_EQ(try_out(stepper(name), linear_spring(0.01), h_omega, 200000).verdict, Verdict::energy);
    }
}

TEST(Steppers, UndampedGrowthOnASpringIsTheFormula) {
  const double offset = 0.1;
  for (const auto name : {"explicit-euler", "trapezoidal"})
    for (const double z : {0.1, 0.5}) {
      SCOPED_TRACE(fmt::format("{} h omega = {}", name, z));
      const double h = z / spring_omega;
      const Trajectory t = trajectory_of(stepper(name), linear_spring(offset), {h, 8 * h, 8});
      const double growth =
          std::string_view(name) == "explicit-euler" ? std::sqrt(1 + z * z) : std::sqrt(1 + z * z * z * z / 4);
      auto amplitude = [&](int i) { return std::hypot(-t.x[i](1, 1) - hanging_length, t.v[i](1, 1) / spring_omega); };
      for (int i = 0; i < 8; ++i)
        // the offset is a difference of lengths of about 1.1 m: some ulps of them, over the amplitude
        EXPECT_NEAR(amplitude(i + 1) / amplitude(i), growth, 16 * eps * hanging_length / offset);
    }
}

TEST(Steppers, ExplicitEulerWithDragHoldsBelowItsLimitAndFailsAbove) {
  const double gamma = 4, limit = gamma / (spring_omega * spring_omega);  // s
  const Scene scene = with_drag(linear_spring(0.01), gamma);
  const Stepper& s = stepper("explicit-euler");
  const Stability below = try_out(s, scene, 0.98 * limit * spring_omega, 20000);
  EXPECT_EQ(below.verdict, Verdict::ok);
  // |lambda|^2 = 1 - h gamma + h^2 omega^2 < 1: the excursion never exceeds the start by more than one step's turn
  EXPECT_LE(below.largest, 0.01 / std::sqrt(1 - 0.04) * (1 + 1e-9));
  EXPECT_EQ(try_out(s, scene, 1.02 * limit * spring_omega, 20000).verdict, Verdict::energy);
}

TEST(Steppers, SymplecticEnergyStaysBoundedForAHundredThousandSteps) {
  Scene scene = load_scene("chain");
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  for (const Stepper& s : steppers()) {
    if (!s.symplectic) continue;
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 100, 20000});
    auto energy = [&](int i) { return energy_of(scene.model, {t.t[i], t.x[i], t.v[i]}).total(); };
    double early = 0, late = 0;
    for (int i = 0; i < t.frames(); ++i) {
      double& part = i < t.frames() / 2 ? early : late;
      part = std::max(part, std::abs(energy(i) - energy(0)));
    }
    // a drift would double the deviation in the second half; a bounded one repeats itself
    EXPECT_LT(late, 1.5 * early);
    EXPECT_GT(early, 0);
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
      if (scene.model.first_order() && !s.first_order) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      const crosscheck::Run run{scene.step, 0.05, 5};
      EXPECT_TRUE(identical(trajectory_of(s, scene, run), trajectory_of(s, scene, run)));
    }
  }
}

TEST(Steppers, EvaluationsAndStepsAreCounted) {
  for (const auto name : {"circle", "pendulum"})
    for (const Stepper& s : steppers()) {
      const Scene scene = load_scene(name);
      if (scene.model.first_order() && !s.first_order) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      Recorder r;
      const Outcome out = simulate(s, ContactRule::coulomb, scene, {0.01, 0.5, 10}, r);
      EXPECT_EQ(out.steps, 50);
      EXPECT_EQ(out.evaluations, 50 * s.evaluations);
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
