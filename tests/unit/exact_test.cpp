// Closed forms: they satisfy their equation, agree with a fine rk4, and are claimed for the scenes they hold for only.
#include <numbers>

#include "experiments/scenes.h"
#include "reference/exact/exact.h"
#include "reference/exact/oscillator.h"
#include "tests/unit/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string spring_text(const std::string& more = "", double start = -0.9, const std::string& free_more = "",
                        const std::string& spring_more = "") {
  return fmt::format(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, {}, 0]\nmass = 2\n{}"
      "[[spring]]\nends = [0, 1]\nstiffness = 200\nrest = 1\n{}{}[pins]\nparticles = [0]\n{}",
      start, free_more, spring_more, gravity_text, more);
}
/// The same with its pin moved along the spring, at a part of its own 10 rad/s.
std::string driven_text(double part, double amplitude, double ramp, const std::string& more = "",
                        const std::string& spring_more = "") {
  return spring_text(fmt::format("[pins.motion]\namplitude = [0, {}, 0]\nfrequency = {}\nramp = {}\n{}", amplitude,
                                 part * 10 / (2 * std::numbers::pi), ramp, more),
                     -0.9, "", spring_more);
}
std::string ball_text(const std::string& more = "") {
  return "[[particle]]\nposition = [1, 2, 3]\nmass = 0.5\nvelocity = [3, 4, -1]\n" + std::string(gravity_text) + more;
}

struct Case {
  std::string name;
  Scene scene;
};
std::vector<Case> with_closed_form() {
  return {
      {"circle", load_scene("circle")},
      {"spring", load_scene("spring")},
      {"underdamped", small_scene(spring_text("[drag]\ngamma = 3\n"))},
      {"critical", small_scene(spring_text("[drag]\ngamma = 20\n"))},  // 2 sqrt(k / m) = 20 /s
      {"overdamped", small_scene(spring_text("[drag]\ngamma = 50\n"))},
      {"overdamped beyond the range of exp", small_scene(spring_text("[drag]\ngamma = 1500\n"))},
      {"moving at the start", small_scene(spring_text("[drag]\ncoefficient = 3\n", -1.05, "velocity = [0, 0.5, 0]\n"))},
      {"dashpot", small_scene(spring_text("", -0.9, "", "dashpot = 8\n"))},
      {"dashpot and drag", small_scene(spring_text("[drag]\ngamma = 3\n", -0.9, "", "dashpot = 8\n"))},
      {"overdamped by the dashpot", small_scene(spring_text("", -0.9, "", "dashpot = 100\n"))},
      {"driven slowly", small_scene(driven_text(0.2, 0.2, 0.5))},
      {"driven fast", small_scene(driven_text(5, 0.1, 0.3))},
      {"driven at once", small_scene(driven_text(0.7, 0.05, 1e-3))},
      {"driven beyond the end", small_scene(driven_text(1.5, 0.1, 3))},
      {"driven beside the resonance", small_scene(driven_text(1.02, 0.004, 0.5))},
      {"driven at resonance, with drag", small_scene(driven_text(1, 0.1, 0.5, "[drag]\ngamma = 3\n"))},
      {"driven through a dashpot", small_scene(driven_text(1, 0.1, 0.5, "", "dashpot = 8\n"))},
      {"driven with both", small_scene(driven_text(0.9, 0.1, 0.3, "[drag]\ngamma = 1\n", "dashpot = 8\n"))},
      {"driven and overdamped", small_scene(driven_text(2, 0.1, 0.3, "[drag]\ngamma = 50\n", "dashpot = 8\n"))},
      {"projectile", small_scene(ball_text())},
      {"projectile with drag", small_scene(ball_text("[drag]\ngamma = 2\n"))},
      {"projectile with faint drag", small_scene(ball_text("[drag]\ngamma = 1e-6\n"))},
      {"projectile in a steady wind", small_scene(ball_text("[drag]\ngamma = 1\n[wind]\nacceleration = [2, 0, 1]\n"))}};
}

TEST(Exact, SatisfiesTheEquationOfMotion) {
  for (const Case& c : with_closed_form()) {
    SCOPED_TRACE(c.name);
    const auto exact = exact_solution(c.scene);
    ASSERT_TRUE(exact);
    System f(c.scene.model);
    const auto* drag = c.scene.model.find<Drag>();
    const double fastest = std::max(10.0, drag ? f.drag_rate().maxCoeff() : 0);  // 1/s: omega is 10 or less
    const double dt = std::cbrt(eps) / fastest;
    // central differences: (rate dt)^2 from the third derivative, eps / dt from rounding, of positions up to 10 m;
    // of velocities the same, faster by the rate
    const double tolerance = 10 * (std::pow(fastest * dt, 2) + eps / dt);
    for (int i = 1; i < 20; ++i) {
      State s = exact->at(0.05 * i), rate = s;
      EXPECT_DOUBLE_EQ(s.t, 0.05 * i);
      f.derivative(s, rate);
      const State up = exact->at(s.t + dt), down = exact->at(s.t - dt);
      EXPECT_LT(((up.x - down.x) / (2 * dt) - rate.x).norm(), tolerance);
      if (s.v.cols() == 0) continue;
      Points off = (up.v - down.v) / (2 * dt) - rate.v;
      for (const int pin : c.scene.model.particles.pins) off.col(pin).setZero();  // they are moved by hand
      EXPECT_LT(off.norm(), fastest * tolerance);
    }
  }
}

TEST(Exact, StartsWhereTheSceneStarts) {
  for (const Case& c : with_closed_form()) {
    SCOPED_TRACE(c.name);
    const State s = exact_solution(c.scene)->at(0);
    EXPECT_LT((s.x - c.scene.start.x).norm(), 4 * eps * 4);  // some ulps of positions up to 4 m
    EXPECT_TRUE(s.v.cols() == 0 || (s.v - c.scene.start.v).norm() < 4 * eps * 6);
  }
}

TEST(Exact, AgreesWithAFineRungeKutta) {
  for (const Case& c : with_closed_form()) {
    SCOPED_TRACE(c.name);
    const Trajectory t = trajectory_of(stepper("rk4"), c.scene, {1e-4, 1, 20});
    const auto exact = exact_solution(c.scene);
    double worst = 0;
    for (int i = 0; i < t.frames(); ++i) worst = std::max(worst, (t.x[i] - exact->at(t.t[i]).x).norm());
    // half an ulp of positions up to 8 m, 1e4 times at worst; rk4 itself loses (h gamma)^4 / 120 = 4e-6 of 1e-3 m at
    // most
    EXPECT_LT(worst, 1e4 * 4 * eps + (c.name.starts_with("overdamped") ? 1e-8 : 0));
  }
}

TEST(Exact, AgreesWithAnAdaptiveRuleOnRandomScenes) {
  for (unsigned seed = 0; seed < 200; seed += 5) {  // a fifth of them, for their time: of each kind as many
    const Scene scene = random_exact_scene(seed);
    SCOPED_TRACE(scene.name);
    const auto exact = exact_solution(scene);
    ASSERT_TRUE(exact);
    crosscheck::Run run = default_run(scene);
    run.tolerance = 1e-11;
    Recorder r;
    const Outcome out = simulate(stepper("dopri5"), ContactRule::coulomb, scene, run, r);
    double worst = 0, farthest = scene.size();
    for (int i = 0; i < r.trajectory.frames(); ++i) {
      const State s = exact->at(r.trajectory.t[i]);
      worst = std::max(worst, (r.trajectory.x[i] - s.x).norm());
      farthest = std::max(farthest, largest_column(s.x));
    }
    // each step may lose its tolerance, of the scene's size and of the position
    EXPECT_LT(worst, static_cast<double>(out.steps) * run.tolerance * farthest);
  }
}

TEST(Exact, IsClaimedOnlyWhereItHolds) {
  const std::string sphere = "[sphere]\ncentre = [0, -9, 0]\nradius = 1\n";
  const std::string gusts =
      "[wind]\nacceleration = [0, 1, 0]\n[wind.gusts]\nvariation = 1\nside = [0, 0, 0]\nseed = 1\n";
  const Case none[] = {
      {"pendulum", load_scene("pendulum")},
      {"chain", load_scene("chain")},
      {"cloth", small_cloth()},
      {"spring beside a sphere", small_scene(spring_text(sphere))},
      {"ball beside a sphere", small_scene(ball_text(sphere))},
      {"spring in gusts", small_scene(spring_text(gusts))},
      {"ball in gusts", small_scene(ball_text(gusts))},
      {"spring in a side wind", small_scene(spring_text("[wind]\nacceleration = [1, 0, 0]\n"))},
      {"spring pushed aside", small_scene(spring_text("", -0.9, "velocity = [0.1, 0, 0]\n"))},
      {"driven aside", small_scene(spring_text("[pins.motion]\namplitude = [0.01, 0, 0]\nfrequency = 1\nramp = 1\n"))},
      {"driven into its anchor", small_scene(driven_text(0.9, 0.2, 0.5))},  // 0.2 m / (1 - 0.81) = 1.05 m
      {"driven at resonance", small_scene(driven_text(1, 1e-6, 0.5))},      // undamped: it grows for ever
      // hanging length 1.0981 m: let go 1.1 m from it, the mass reaches the anchor
      {"spring that reaches the anchor", small_scene(spring_text("", -2.2))}};
  for (const Case& c : none) {
    SCOPED_TRACE(c.name);
    EXPECT_FALSE(exact_solution(c.scene));
  }
  EXPECT_TRUE(exact_solution(small_scene(spring_text("", -2.19))));  // 1.092 m from it: just not
}

TEST(Exact, TruthSaysItsTier) {
  EXPECT_EQ(truth_of(load_scene("circle"), {0.05, 1, 10})->tier, Tier::exact);
  EXPECT_EQ(truth_of(load_scene("spring"), {0.05, 1, 10})->tier, Tier::exact);
  const auto converged = truth_of(load_scene("pendulum"), {0.05, 1, 10});
  ASSERT_TRUE(converged);
  EXPECT_EQ(converged->tier, Tier::converged);
  EXPECT_FALSE(truth_of(load_scene("cloth-sphere"), {1e-3, 0.1, 10}));
  // the error bar of the converged truth covers its distance to a far finer one
  const Trajectory finer = trajectory_of(stepper("rk4"), load_scene("pendulum"), {2e-5, 1, 10});
  EXPECT_LE(sup_rms(converged->trajectory, finer), converged->bar + 5e4 * 0.5 * eps);  // 5e4 steps' worst rounding
}

TEST(RigidPendulum, PeriodAgainstKnownValues) {
  const double small = 2 * std::numbers::pi * std::sqrt(1 / 9.81);
  EXPECT_NEAR(rigid_pendulum_period(1, 9.81, 1e-8), small, 4 * eps * small);
  // 2 K(sin(theta0 / 2)) / pi from tables of the complete elliptic integral; ten roundings
  const std::pair<double, double> table[] = {{90, 1.1803405990161}, {60, 1.0731820071493}, {120, 1.3728805006183}};
  for (const auto& [degrees, ratio] : table)
    EXPECT_NEAR(rigid_pendulum_period(1, 9.81, degrees * std::numbers::pi / 180) / small, ratio, 2e-13);
  EXPECT_NEAR(rigid_pendulum_period(4, 9.81, 1), 2 * rigid_pendulum_period(1, 9.81, 1), 1e-14);  // sqrt(L)
  // first terms of the series: 1 + theta^2/16 + 11 theta^4/3072; the next is 173 theta^6 / 737280
  EXPECT_NEAR(rigid_pendulum_period(1, 9.81, 0.1) / small, 1 + 0.01 / 16 + 11e-4 / 3072, 3e-10);
}

/// Mean period of the first swings of the shipped pendulum with another stiffness, from crossings of the plumb line.
double swing_period(double stiffness) {
  Scene scene = load_scene("pendulum");
  for (Term& term : scene.model.terms)
    if (auto* springs = std::get_if<Springs>(&term)) springs->list[0].k = stiffness;
  const double h = 0.1 / std::sqrt(stiffness);
  const Trajectory t = trajectory_of(stepper("rk4"), scene, {h, 12, 12000});
  double first = 0, last = 0;
  int periods = -1;
  for (int i = 1; i < t.frames(); ++i) {
    const double a = t.x[i - 1](0, 1), b = t.x[i](0, 1);
    if (a > 0 || b <= 0) continue;
    last = t.t[i - 1] + (t.t[i] - t.t[i - 1]) * a / (a - b);
    if (++periods == 0) first = last;
  }
  return (last - first) / periods;
}

TEST(RigidPendulum, IsTheLimitOfTheSpringPendulumToFirstOrderInOneOverK) {
  const double rigid = rigid_pendulum_period(1, 9.81, 60 * std::numbers::pi / 180);
  double before = 0;
  for (const double k : {1e3, 1e4, 1e5}) {
    SCOPED_TRACE(k);
    const double deviation = swing_period(k) / rigid - 1;
    EXPECT_NEAR(deviation / (9.81 / k), 1.15, 0.1);  // the factor of facts/scenes.md, section 4, read to two digits
    // the next order is m g / (k L), at most 1 % of the deviation
    if (before > 0) {
      EXPECT_NEAR(std::log10(before / deviation), 1, 0.05);
    }
    before = deviation;
  }
}

}  // namespace
}  // namespace crosscheck
