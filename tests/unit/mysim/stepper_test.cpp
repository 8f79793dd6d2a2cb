// Steppers: the table, the declarations of each row, stability on both sides of the limit, determinism, counts, and the
// advantage of suzuki4.

#include <complex>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/run/observers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/mysim/declared.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Steppers, SymplecticOnesKeepAreasAndOthersDoNot) {
  for (const Stepper& s : fixed_steppers()) {
    const double change = std::abs(step_matrix(s, 10, 0, 0.02).determinant() - 1);
    EXPECT_EQ(change < 1e-11, s.symplectic) << s.name << ": " << change;
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
  // Each of a hundred steps adds a few ulps of 1 m.
  EXPECT_LT((s.x - scene.start.x).cwiseAbs().maxCoeff(), 1e3 * eps);
}

TEST(Steppers, TwoRunsAreBitEqual) {
  for (const auto& name : shipped_scene_names()) {
    const Scene scene = shipped_scene(std::string(name));
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
      const Scene scene = shipped_scene(name);
      if (!takes(s, scene)) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, s.name));
      Recorder r;
      const Outcome out = simulate(s, ContactRule::coulomb, scene, {0.01, 0.5, 10}, r);
      EXPECT_EQ(out.steps, 50);
      if (s.evaluations > 0)
        // A rule that reuses the last stage of the previous step must evaluate it again if steps are fixed.
        EXPECT_EQ(out.evaluations, 50 * (s.evaluations + stepper(s.name).adaptive));
      else
        EXPECT_GE(out.evaluations, 2 * 50);  // forces at the start and end of the solve
      EXPECT_EQ(r.trajectory.frames(), 11);
      EXPECT_DOUBLE_EQ(out.end, 0.5);
    }
}

TEST(Steppers, FirstOrderScenesAreRefusedByRulesThatNeedVelocities) {
  const Scene scene = shipped_scene("circle");
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    Recorder r;
    if (s.first_order)
      EXPECT_NO_THROW(simulate(s, ContactRule::coulomb, scene, default_run(scene), r));
    else
      EXPECT_THROW(simulate(s, ContactRule::coulomb, scene, default_run(scene), r), Unsupported);
  }
}

TEST(TimeGrid, DividesTheSamplingIntervalAndIsNeverLongerThanAsked) {
  for (const double step : {1e-3, 3e-4, 0.0123, 0.5, 7.0})
    for (const int samples : {1, 7, 150}) {
      const TimeGrid p = time_grid({step, 3, samples});
      EXPECT_LE(p.h, std::min(step, 3.0 / samples) * (1 + 1e-9));  // unchanged if only round-off prevents division
      EXPECT_NEAR(p.h * p.steps_per_sample * p.samples, 3, 4 * eps * 3);
    }
}

TEST(TimeGrid, RefusesMoreStepsThanCanBeCounted) {
  // These are 5e13 steps per sampling interval. A count that wraps would silently use a single step per interval.
  EXPECT_THROW(time_grid({1e-13, 5, 1}), InputError);
  EXPECT_THROW(time_grid({1e-300, 5, 250}), InputError);
}

}  // namespace

// Stability of every stepper on both sides of its row's limit, by the step matrix and by a run, and the verdict on
// springs that only get longer.

namespace {

using namespace testing_tools;

TEST(Stability, StepMatrixTurnsUnstableAtTheLimit) {
  for (const Stepper& s : fixed_steppers())
    for (const auto& [omega, gamma] : oscillations) {
      SCOPED_TRACE(fmt::format("{} omega = {} gamma = {}", s.name, omega, gamma));
      const double limit = s.limit(omega, gamma);
      auto radius = [&](double h) { return spectral_radius(step_matrix(s, omega, gamma, h), omega); };
      if (std::isinf(limit)) {
        for (const double h_omega : {0.1, 1.0, 10.0, 100.0})
          // Implicit rules solve to at least 1e-10 of the forces, which are up to (h omega)^2 times the force of the
          // offset.
          EXPECT_LE(radius(h_omega / omega), 1 + 1e-6);
      } else if (limit == 0) {
        // the slowest growth is (h omega)^4 / 8 per step
        for (const double h_omega : {0.1, 0.5}) EXPECT_GT(radius(h_omega / omega), 1 + 1e-6);
      } else {
        // Coincident eigenvalues on the unit circle are accurate only to the square root of the round-off (1e-13).
        for (const double part : {0.1, 0.5, 0.9, 0.999}) EXPECT_LE(radius(part * limit), 1 + 1e-11) << part;
        EXPECT_GT(radius(1.001 * limit), 1 + 1e-8);  // the smallest growth is that of dopri5 without drag: 6e-7
      }
    }
}

TEST(Stability, TheFormulaInWordsHasTheNumbersOfTheLimit) {
  auto number_after = [](std::string_view text, std::string_view words, std::string_view then) {
    const size_t at = text.find(words);
    double value = NAN;
    size_t length = 0;
    if (at != std::string_view::npos) {
      value = std::strtod(std::string(text.substr(at + words.size())).c_str(), nullptr);
      length = text.substr(at + words.size()).find_first_not_of("0123456789.");
    }
    return at != std::string_view::npos && text.substr(at + words.size() + length).starts_with(then) ? value : NAN;
  };
  int found = 0;
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const double spring = number_after(s.limit_formula, "h omega < ", " without drag"),
                 drag = number_after(s.limit_formula, "h gamma < ", " without springs");
    // the text has two decimal places, or one for dopri5
    for (const auto& [written, limit] : {std::pair{spring, s.limit(1, 0)}, std::pair{drag, s.limit(0, 1)}}) {
      if (std::isnan(written)) continue;
      EXPECT_NEAR(limit, written, 0.01);
      ++found;
    }
  }
  EXPECT_GE(found, 5);  // rk4, symplectic-euler, suzuki4 twice, dopri5
}

TEST(Stability, DragAloneHasTheLimitOfTheRowToo) {
  const double gamma = 5;
  for (const Stepper& s : fixed_steppers()) {
    SCOPED_TRACE(s.name);
    const double limit = s.limit(0, gamma);
    EXPECT_GT(limit, 0);
    // Without a spring the position never returns, so only the velocity entry of the matrix matters.
    auto factor = [&](double h) { return std::abs(step_matrix(s, 0, gamma, h)(1, 1)); };
    EXPECT_LE(factor(std::isinf(limit) ? 100 / gamma : 0.999 * limit), 1 + 1e-9);
    if (std::isfinite(limit)) {
      EXPECT_GT(factor(1.001 * limit), 1 + 1e-6);
    }
  }
}

/// Largest excursions (m) in the first and the last tenth of a run.
class Excursions : public Observer {
 public:
  Excursions(double rest, double duration) : rest_(rest), duration_(duration) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    const double excursion = std::abs(state.x(1, 1) - rest_);
    if (state.t <= 0.1 * duration_) first = std::max(first, excursion);
    if (state.t >= 0.9 * duration_) last = std::max(last, excursion);
    return Verdict::ok;
  }
  double first = 0, last = 0;

 private:
  double rest_, duration_;
};

struct Fate {
  Verdict verdict;
  double growth;  // excursions in the last tenth divided by those in the first tenth
};
/// Runs for h * steps seconds. `steps` must be a multiple of ten: otherwise steps would be shorter, to end at samples.
Fate try_out(const Stepper& s, const Oscillation& o, double h, int steps) {
  Scene scene = hanging(o.omega, o.gamma);
  const double rest = scene.start.x(1, 1);
  scene.start.x(1, 1) -= 0.01;
  const crosscheck::Run run{h, h * steps, 10};
  DivergenceMonitor monitor(scene, run);
  Excursions excursions(rest, h * steps);
  Observers both({&monitor, &excursions});
  const Outcome out = simulate(s, ContactRule::coulomb, scene, run, both);
  return {out.verdict, excursions.last / excursions.first};
}

TEST(Stability, RunsHoldBelowTheLimitAndFailAbove) {
  for (const Stepper& s : fixed_steppers())
    for (const Oscillation& o : {Oscillation{10, 0}, {10, 2}, {10, 15}, {10, 50}}) {
      SCOPED_TRACE(fmt::format("{} omega = {} gamma = {}", s.name, o.omega, o.gamma));
      const double limit = s.limit(o.omega, o.gamma);
      if (limit > 0) {
        const bool any = std::isinf(limit);
        const Fate below = try_out(s, o, any ? 100 / o.omega : 0.98 * limit, any ? 1000 : 10000);
        EXPECT_EQ(below.verdict, Verdict::ok);
        // within a hundred steps, the samples of a stable orbit come within 1e-3 of its maximum
        EXPECT_LE(below.growth, 1 + 1e-3);
      }
      if (std::isfinite(limit)) {
        const double above = just_above(s, o.omega, o.gamma);
        // Number of steps in which the step matrix grows by a factor of 1000 (if drag dominates, the growing vector is
        // a thirtieth of the initial state). Nine tenths of them lie between the first and the last tenth of the run.
        // The slowest growth is that of dopri5 without drag: 1.3e-5 per step.
        const double growth = spectral_radius(step_matrix(s, o.omega, o.gamma, above), o.omega);
        const int steps = 10 * (10 + static_cast<int>(std::min(1e5, 0.1 * std::log(1000) / std::log(growth))));
        const Fate fate = try_out(s, o, above, steps);
        EXPECT_TRUE(fate.verdict != Verdict::ok || fate.growth > 5)
            << name_of(fate.verdict) << ", growth " << fate.growth;
      }
    }
}

TEST(Stability, UndampedGrowthOnASpringIsTheFormula) {
  const double offset = 0.1, omega = 10;
  Scene scene = hanging(omega, 0);
  const double rest = scene.start.x(1, 1);
  scene.start.x(1, 1) -= offset;
  for (const auto name : {"explicit-euler", "trapezoidal"})
    for (const double z : {0.1, 0.5}) {
      SCOPED_TRACE(fmt::format("{} h omega = {}", name, z));
      const double h = z / omega;
      const Trajectory t = trajectory_of(stepper(name), scene, {h, 8 * h, 8});
      const double growth =
          std::string_view(name) == "explicit-euler" ? std::sqrt(1 + z * z) : std::sqrt(1 + z * z * z * z / 4);
      auto amplitude = [&](int i) { return std::hypot(t.x[i](1, 1) - rest, t.v[i](1, 1) / omega); };
      for (int i = 0; i < 8; ++i)
        // The offset is a difference of lengths of about 1.1 m: its error is some ulps of these, relative to the
        // amplitude.
        EXPECT_NEAR(amplitude(i + 1) / amplitude(i), growth, 16 * eps * 1.1 / offset);
    }
}

TEST(Stability, WhatHangsStillStaysWhereItHangs) {
  // equilibria depend neither on the step nor on drag
  for (const Stepper& s : fixed_steppers())
    for (const double gamma : {0.0, 4.0, 30.0}) {
      SCOPED_TRACE(fmt::format("{} gamma = {}", s.name, gamma));
      const Scene scene = hanging(10, gamma);
      const Trajectory t = trajectory_of(s, scene, {0.01, 0.1, 10});
      // the tolerance covers ten steps with errors of some ulps of 1 m
      for (const Points& x : t.x) EXPECT_NEAR(x(1, 1), scene.start.x(1, 1), 100 * eps);
    }
}

/// Verdict for 1 kg on a spring of 1 N/m and 1 m that is suddenly stretched by `extension` (m), without any speed.
Verdict verdict_at(double extension) {
  Scene scene = hanging(1, 0);
  scene.start.x(1, 1) = -1;
  const crosscheck::Run run{0.01, 4, 4};
  DivergenceMonitor monitor(scene, run);
  EXPECT_EQ(monitor.observe(scene.start, true), Verdict::ok);
  State state = scene.start;
  state.t = 1;
  state.x(1, 1) = -1 - extension;
  return monitor.observe(state, true);
}

TEST(Stretch, IsAVerdictBesideEnergy) {
  // In free fall from rest, the true extension is at most 2 W / k = 19.62 m beyond the rest length of 1 m. The bound is
  // ten times the largest length, 206.2 m, accurate to 3 %. Two states alone do not give a speed, so only the length is
  // tested.
  EXPECT_EQ(verdict_at(19.62), Verdict::ok);
  EXPECT_EQ(verdict_at(199), Verdict::ok);
  EXPECT_EQ(verdict_at(212), Verdict::stretch);
  EXPECT_EQ(name_of(Verdict::stretch), "stretch");
}

using namespace testing_tools;

/// Error of rk4 at h divided by that of suzuki4 at 1.25 h; both need 4 evaluations per h.
double advantage(const Scene& scene, double h, double duration) {
  // samples at multiples of 5 h, which both steps divide
  const int samples = static_cast<int>(std::lround(duration / (20 * h)));
  const Trajectory truth = trajectory_of(at_fixed_step(stepper("dopri5")), scene, {h / 4, duration, samples});
  Recorder one, other;
  const Outcome a = simulate(stepper("rk4"), ContactRule::coulomb, scene, {h, duration, samples}, one);
  const Outcome b = simulate(stepper("suzuki4"), ContactRule::coulomb, scene, {1.25 * h, duration, samples}, other);
  EXPECT_EQ(a.evaluations, b.evaluations);
  const double rk4 = sup_rms(one.trajectory, truth), suzuki4 = sup_rms(other.trajectory, truth);
  fmt::print("{:12} h = {:.3g} s: rk4 {:.3g} m, suzuki4 {:.3g} m, {:.2f} times\n", scene.name, h, rk4, suzuki4,
             rk4 / suzuki4);
  return rk4 / suzuki4;
}

TEST(SameWork, Suzuki4IsTwiceAsAccurateAsRk4OnTheChain) {
  for (const double h : {2e-3, 1e-3, 5e-4}) EXPECT_GT(advantage(shipped_scene("chain"), h, 1), 2);
}

TEST(SameWork, Suzuki4IsTwiceAsAccurateAsRk4OnTheHangingCloth) {
  for (const double h : {7.5e-4, 3.75e-4}) EXPECT_GT(advantage(shipped_scene("cloth-hang"), h, 0.15), 2);
}

}  // namespace
}  // namespace crosscheck
