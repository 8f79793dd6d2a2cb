// The divergence monitor's verdict is ok up to the limit of a rule, a failure beyond it at the right time, and ok for
// runs that only resemble a failure.

#include <numbers>
#include <optional>

#include "mysim/run/observers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/mysim/declared.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// A mass of 1 kg on a spring of 100 N/m with a rest length of 1 m, without gravity.
Scene kilogram(double start, double speed, double duration = 20) {
  return small_scene(fmt::format("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [{}, 0, 0]\n"
                                 "mass = 1\nvelocity = [{}, 0, 0]\n[[spring]]\nends = [0, 1]\nstiffness = 100\n"
                                 "rest = 1\n[pins]\nparticles = [0]\n",
                                 start, speed),
                     duration);
}

TEST(DivergenceMonitorOnASpring, HoldsAHundredthBelowTheLimitAndFailsAHundredthAbove) {
  for (const Scene& scene : {kilogram(1.1, 0), kilogram(1, 1), kilogram(1.05, -0.7)})
    for (const char* name : {"leapfrog", "symplectic-euler", "suzuki4", "rk4"}) {
      const double limit = stepper(name).limit(10, 0);
      for (const int per_sample : {1, 2, 3, 7, 200})
        for (const double part : {0.5, 0.9, 0.99, 1.01}) {
          SCOPED_TRACE(fmt::format("{} at {} of its limit, {} steps a sample", name, part, per_sample));
          const double h = part * limit;
          const int samples = 4200 / per_sample;
          const MethodRun a = run_and_record(name, scene, {h, h * per_sample * samples, samples});
          // Speeds are central differences. At the limit of rk4, where a step covers 109 degrees of the vibration,
          // central differences are a third of rk4's own velocities. At 1.01 of the limit they stay at four times the
          // true speed.
          if (part < 1 || name == std::string("rk4"))
            EXPECT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
          else
            EXPECT_NE(a.outcome.verdict, Verdict::ok);
        }
    }
}

TEST(DivergenceMonitorOnASpring, JudgesAtTheStepOfLeavingOrTheNextSample) {
  // 1 % above the limit the solution is x_n = (-1)^n A cosh(n p) with p = 2 acosh(1.01) = 0.28 and A = 0.1 m. K^
  // exceeds the available energy before the speed is ten times the true speed of 1 m/s, so the true motion is computed
  // in time.
  const Scene scene = kilogram(1.1, 0);
  const double h = 0.202;
  for (const int per_sample : {1, 40, 1000}) {
    SCOPED_TRACE(per_sample);
    const crosscheck::Run run{h, h * 2000, 2000 / per_sample};
    const long left = step_of_leaving(scene, run, "leapfrog", 1);
    const MethodRun a = run_and_record("leapfrog", scene, run);
    EXPECT_GT(left, 10);
    EXPECT_NE(a.outcome.verdict, Verdict::ok);
    EXPECT_GE(a.outcome.steps, left);
    EXPECT_LE(a.outcome.steps, (left + per_sample - 1) / per_sample * per_sample);
  }
}

TEST(DivergenceMonitorOnASpring, SeesBlowUpsBetweenSamples) {
  // 10 % above the limit K^ grows by exp(2 * 0.887) per step: from B to 1000 B in four steps, all of which are
  // observed.
  const Scene scene = kilogram(1.1, 0);
  const double h = 0.22;
  const MethodRun a = run_and_record("leapfrog", scene, {h, h * 2000, 2});
  EXPECT_EQ(a.outcome.verdict, Verdict::energy);
  EXPECT_LE(a.outcome.steps, 48);
}

TEST(DivergenceMonitorOnASpring, JudgesGrowthThatIsCertainAsRun) {
  // The amplitude of explicit Euler grows by (1 + z^2)^(1/2) per step: ten times the true speed after ln(100) / ln(1 +
  // z^2) steps. With an amplitude of 1 mm the spring stays far from zero length.
  const double z = 0.05, h = z / 10, steps_to_verdict = std::log(100) / std::log1p(z * z);
  for (const double part : {0.9, 1.1}) {
    const int steps = static_cast<int>(part * steps_to_verdict);
    const MethodRun a = run_and_record("explicit-euler", kilogram(1.001, 0), {h, h * steps, steps});
    EXPECT_EQ(a.outcome.verdict, part < 1 ? Verdict::ok : Verdict::energy) << part;
  }
}

TEST(DivergenceMonitorOnASpring, NeedsNoVelocities) {
  struct WithoutVelocities : Observer {  // like an external engine that reports no velocities
    explicit WithoutVelocities(DivergenceMonitor& w) : monitor(w) {}
    Verdict observe(const State& s, bool sample) override { return monitor.observe({s.t, s.x, Points(3, 0)}, sample); }
    DivergenceMonitor& monitor;
  };
  for (const double speed : {0., 3.}) {
    const Scene scene = kilogram(1, speed);
    for (const double h : {0.05, 0.205}) {
      DivergenceMonitor monitor(scene.model, &scene.start);
      WithoutVelocities positions(monitor);
      // nothing moves from rest at the spring's rest length
      const Verdict expected = h > 0.2 && speed > 0 ? Verdict::energy : Verdict::ok;
      EXPECT_EQ(simulate(stepper("leapfrog"), ContactRule::coulomb, scene, {h, 400 * h, 400}, positions).verdict,
                expected);
    }
  }
}

TEST(DivergenceMonitorOnASpring, IsTheSameWithOtherObservers) {
  const Scene scene = kilogram(1.1, 0);
  for (const double h : {0.199, 0.203}) {
    const crosscheck::Run run{h, 1000 * h, 10};
    Ledger ledger(scene.model, ContactLoss::reported);
    const Outcome seen = run_method(find_method("leapfrog"), scene, run, {&ledger}),
                  alone = run_method(find_method("leapfrog"), scene, run, {});
    EXPECT_EQ(seen.verdict, alone.verdict);
    EXPECT_EQ(seen.steps, alone.steps);
  }
}

TEST(DivergenceMonitorOnSoftLinks, PassesPositionBasedClothsThatFallSmoothly) {
  for (const char* name : {"cloth-hang", "cloth-stiff"})
    for (const char* method : {"bullet/pbd", "xpbd"})
      for (const double h : {1. / 60, 1. / 90, 1. / 150}) {
        Scene scene = shipped_scene(name);
        const MethodRun a = run_and_record(method, scene, {h, scene.duration, scene.samples});
        SCOPED_TRACE(fmt::format("{} on {} at {:.3g} s", method, name, h));
        EXPECT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
        EXPECT_NEAR(a.outcome.end, scene.duration, 1e-9);
      }
}

/// Verdict on a particle on a spring at these positions (m), one second apart.
Verdict verdict_on(const std::vector<double>& along, bool knows_the_scene) {
  const Scene scene = kilogram(1.1, 0);  // 0.5 J, pull 100 kg m^2/s^4: B = 200.5 J for steps of 1 s
  const crosscheck::Run run{1, 10, 10};
  DivergenceMonitor monitor =
      knows_the_scene ? DivergenceMonitor(scene, run) : DivergenceMonitor(scene.model, &scene.start);
  State state = scene.start;
  Verdict last = monitor.observe(state, true);
  for (const double x : along) {
    state.t += 1, state.x(0, 1) = x;
    if (last == Verdict::ok) last = monitor.observe(state, true);
  }
  return last;
}

TEST(DivergenceMonitorOnSamples, HoldsSpeedsAndLengthsAgainstTheTrueMotion) {
  // The true motion reaches 1.1 m and 1 m/s. Ten times these are 11 m and, over two samples, a path of 20 m.
  EXPECT_EQ(verdict_on({1.2, 10.9}, true), Verdict::ok);
  EXPECT_EQ(verdict_on({1.2, 11.2}, true), Verdict::stretch);
  EXPECT_EQ(verdict_on({1.2, 21}, true), Verdict::stretch);
  EXPECT_EQ(verdict_on({1.2, 22}, true), Verdict::energy);
  EXPECT_EQ(verdict_on({-9, -5, 10.9}, true), Verdict::ok);  // 19.9 m
}

TEST(DivergenceMonitorOnSamples, GoesByEnergyWhereThereIsNothingToHoldThemAgainst) {
  // K^ = (x_2 - x_0)^2 / 8 exceeds 10 B = 2005 J beyond 126.6 m; the limit of stretch, 30 initial lengths, is 33 m
  EXPECT_EQ(verdict_on({1.2, 32}, false), Verdict::ok);
  EXPECT_EQ(verdict_on({1.2, 34}, false), Verdict::stretch);
  EXPECT_EQ(verdict_on({1.2, 140}, false), Verdict::energy);
}

TEST(MotionBounds, IsThatOfTheClosedForm) {
  const Scene scene = kilogram(1.1, 0);  // bounds are accurate to 3 %: a quarter of the limit is h omega = 0.5
  const auto bounds = motion_bounds_of(scene, {0.1, 20, 10});
  ASSERT_TRUE(bounds.has_value());
  EXPECT_NEAR(bounds->speed, 1, 0.04);
  EXPECT_NEAR(bounds->stretch, 1.1, 1e-12);
  EXPECT_FALSE(motion_bounds_of(shipped_scene("cloth-inextensible"), {0.01, 0.1, 1}).has_value());
}

bool tells_passage(const std::string& method, const Scene& scene) {
  const MethodRun a = run_and_record(method, scene, default_run(scene));
  EXPECT_EQ(a.outcome.verdict, Verdict::ok);
  return a.outcome.remark.find("passed through a sphere") != std::string::npos;
}

TEST(Passages, AreToldWhereEveryStepEndsOutsideABallOnTheWay) {
  Random random(7);
  int passed = 0, touched = 0, missed = 0;
  for (int i = 0; i < 60; ++i) {
    const double radius = random.between(0.02, 0.3), h = 0.01, speed = random.between(0.5, 6) * radius / h;
    const double aside = random.between(0, 1.5) * radius, start = -random.between(7, 12) * radius;
    const double drift = i % 2 == 0 ? 0 : random.between(-1, 1);  // m/s, final speed of the ball
    if (std::abs(aside / radius - 1) < 1e-3) continue;
    const int steps = static_cast<int>(16 * radius / (speed * h)) + 2;
    const Scene scene = small_scene(
        fmt::format("[[particle]]\nposition = [{}, {}, 0]\nmass = 1\nvelocity = [{}, {}, 0]\n[sphere]\n"
                    "centre = [0, 0, 0]\nradius = {}\nrestitution = 0.5\n{}",
                    start, aside, speed, drift, radius,
                    drift == 0 ? ""
                               : fmt::format("[sphere.motion]\namplitude = [0, {}, 0]\nfrequency = 1e-3\nramp = 1e-6\n",
                                             drift / (2 * std::numbers::pi * 1e-3))),
        steps * h, h, i % 3 == 0 ? 1 : steps);
    // The ball's motion is nearly uniform in this time, so the particle flies along a line relative to it. A step that
    // ends inside the ball, past its centre, pushes the particle out on the far side, which is also a passage.
    int k = 0;
    while (k <= steps && std::hypot(start + k * h * speed, aside) >= radius) ++k;
    const bool touches = k <= steps && start + k * h * speed < 0, passes = !touches && aside < radius;
    (passes ? passed : touches ? touched : missed)++;
    for (const char* method : {"leapfrog", "rk4", "implicit-euler", "dopri5"})
      EXPECT_EQ(tells_passage(method, scene), passes) << method << " " << i << " " << aside / radius;
    EXPECT_FALSE(tells_passage("leapfrog+events", scene)) << i;
  }
  EXPECT_GT(std::min({passed, touched, missed}), 5);
}

TEST(Passages, AreNotToldWhereOnlyTheChordOfACurvedPathCutsABall) {
  for (const double over : {0.01, 0.5, 0.99, -4.}) {  // in units of g h^2 / 8, the sagitta of a step's chord
    const double h = 0.02, speed = 3, bend = 9.81 * h * h / 8, top = 1 + over * bend;
    const Scene scene = small_scene(
        fmt::format("[[particle]]\nposition = [{}, {:.17g}, 0]\nmass = 1\nvelocity = [{}, {:.17g}, 0]\n[sphere]\n"
                    "centre = [0, 0.9, 0]\nradius = 0.1\n{}",
                    -1.5 * h * speed, top - 9 * bend, speed, 1.5 * h * 9.81, gravity_text),
        3 * h, h, 3);
    EXPECT_EQ(tells_passage("leapfrog", scene), over < 0) << over;
  }
}

}  // namespace
}  // namespace crosscheck
