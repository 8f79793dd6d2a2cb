// Closed forms satisfy their equations, agree with a fine rk4, are claimed only for valid scenes, and are the limits of
// the corresponding scenes.

#include <numbers>

#include "mysim/model/system.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/exact/linear.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/limits_of_motion.h"
#include "tests/unit/reference/random_scenes.h"

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
/// The spring of spring_text(), with its pin moved along it at `part` times the natural frequency of 10 rad/s.
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
      {"circle", shipped_scene("circle")},
      {"spring", shipped_scene("spring")},
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
    const double fastest = std::max(10.0, drag ? f.drag_rate().maxCoeff() : 0);  // 1/s; omega is at most 10
    const double dt = std::cbrt(eps) / fastest;
    // Central differences err by (rate dt)^2 from the third derivative and by eps / dt from rounding, for positions up
    // to 10 m. The errors of velocities are larger by a factor of the rate.
    const double tolerance = 10 * (std::pow(fastest * dt, 2) + eps / dt);
    for (int i = 1; i < 20; ++i) {
      State s = exact->at(0.05 * i), rate = s;
      EXPECT_DOUBLE_EQ(s.t, 0.05 * i);
      f.derivative(s, rate);
      const State up = exact->at(s.t + dt), down = exact->at(s.t - dt);
      EXPECT_LT(((up.x - down.x) / (2 * dt) - rate.x).norm(), tolerance);
      if (s.v.cols() == 0) continue;
      Points off = (up.v - down.v) / (2 * dt) - rate.v;
      for (const int pin : c.scene.model.particles.pins) off.col(pin).setZero();  // prescribed motion
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
    // rk4 rounds positions up to 8 m by at most half an ulp in each of 1e4 steps. Its own error is at most (h gamma)^4
    // / 120 = 4e-6 of 1e-3 m.
    EXPECT_LT(worst, 1e4 * 4 * eps + (c.name.starts_with("overdamped") ? 1e-8 : 0));
  }
}

TEST(Exact, AgreesWithAnAdaptiveRuleOnRandomScenes) {
  for (unsigned seed = 0; seed < 200; seed += 5) {  // every fifth seed, to save time; all kinds occur equally often
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
    // Each step may err by the tolerance, relative to the scene's size and to the position.
    EXPECT_LT(worst, static_cast<double>(out.steps) * run.tolerance * farthest);
  }
}

TEST(Exact, IsClaimedOnlyWhereItHolds) {
  const std::string sphere = "[sphere]\ncentre = [0, -9, 0]\nradius = 1\n";
  const std::string gusts =
      "[wind]\nacceleration = [0, 1, 0]\n[wind.gusts]\nvariation = 1\nside = [0, 0, 0]\nseed = 1\n";
  const Case none[] = {
      {"pendulum", shipped_scene("pendulum")},
      {"chain", shipped_scene("chain")},
      {"cloth", small_cloth()},
      {"spring beside a sphere", small_scene(spring_text(sphere))},
      {"ball beside a sphere", small_scene(ball_text(sphere))},
      {"spring in gusts", small_scene(spring_text(gusts))},
      {"ball in gusts", small_scene(ball_text(gusts))},
      {"spring in a side wind", small_scene(spring_text("[wind]\nacceleration = [1, 0, 0]\n"))},
      {"spring pushed aside", small_scene(spring_text("", -0.9, "velocity = [0.1, 0, 0]\n"))},
      {"driven aside", small_scene(spring_text("[pins.motion]\namplitude = [0.01, 0, 0]\nfrequency = 1\nramp = 1\n"))},
      {"driven into its anchor", small_scene(driven_text(0.9, 0.2, 0.5))},  // 0.2 m / (1 - 0.81) = 1.05 m
      {"driven at resonance", small_scene(driven_text(1, 1e-6, 0.5))},      // undamped: unbounded growth
      // equilibrium length 1.0981 m: released 1.1 m from it, the mass reaches the anchor
      {"spring that reaches the anchor", small_scene(spring_text("", -2.2))}};
  for (const Case& c : none) {
    SCOPED_TRACE(c.name);
    EXPECT_FALSE(exact_solution(c.scene));
  }
  EXPECT_TRUE(exact_solution(small_scene(spring_text("", -2.19))));  // 1.092 m from equilibrium: short of the anchor
}

TEST(Exact, TruthSaysItsTier) {
  EXPECT_EQ(truth_of(shipped_scene("circle"), {0.05, 1, 10})->tier, Tier::exact);
  EXPECT_EQ(truth_of(shipped_scene("spring"), {0.05, 1, 10})->tier, Tier::exact);
  const auto converged = truth_of(shipped_scene("pendulum"), {0.05, 1, 10});
  ASSERT_TRUE(converged);
  EXPECT_EQ(converged->tier, Tier::converged);
  EXPECT_EQ(truth_of(shipped_scene("cloth-sphere"), {1e-3, 0.1, 10})->tier, Tier::converged);  // still falling
  // the error bar of the converged truth covers its distance to a far finer one
  const Trajectory finer = trajectory_of(stepper("rk4"), shipped_scene("pendulum"), {2e-5, 1, 10});
  EXPECT_LE(sup_rms(converged->trajectory, finer),
            converged->error_bar + 5e4 * 0.5 * eps);  // worst-case rounding of 5e4 steps
}

TEST(RigidPendulum, PeriodAgainstKnownValues) {
  const double small = 2 * std::numbers::pi * std::sqrt(1 / 9.81);
  EXPECT_NEAR(rigid_pendulum_period(1, 9.81, 1e-8), small, 4 * eps * small);
  // 2 K(sin(theta0 / 2)) / pi from tables of the complete elliptic integral; the bound is ten roundings
  const std::pair<double, double> table[] = {{90, 1.1803405990161}, {60, 1.0731820071493}, {120, 1.3728805006183}};
  for (const auto& [degrees, ratio] : table)
    EXPECT_NEAR(rigid_pendulum_period(1, 9.81, degrees * std::numbers::pi / 180) / small, ratio, 2e-13);
  EXPECT_NEAR(rigid_pendulum_period(4, 9.81, 1), 2 * rigid_pendulum_period(1, 9.81, 1), 1e-14);  // sqrt(L)
  // first terms of the series: 1 + theta^2/16 + 11 theta^4/3072; the next is 173 theta^6 / 737280
  EXPECT_NEAR(rigid_pendulum_period(1, 9.81, 0.1) / small, 1 + 0.01 / 16 + 11e-4 / 3072, 3e-10);
}

/// Mean period of the first swings of the shipped pendulum with a different stiffness, from its passages through the
/// vertical.
double swing_period(double stiffness) {
  Scene scene = shipped_scene("pendulum");
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
    EXPECT_NEAR(deviation / (9.81 / k), 1.15, 0.1);  // 1.15 m g / (k L) at 60 degrees, two digits
    // the next order is smaller by m g / (k L), at most 1 %
    if (before > 0) {
      EXPECT_NEAR(std::log10(before / deviation), 1, 0.05);
    }
    before = deviation;
  }
}

using namespace testing_tools;

TEST(HangingRest, CarriesTheWeightBelow) {
  SceneWriter w;  // a chain of two, with a branch at the first
  w.particle({0, 0, 0}, 1);
  w.particle({1, 0, 0}, 0.5);
  w.particle({2, 0, 0}, 0.25);
  w.particle({1, 1, 0}, 2);
  w.spring(2, 1, 10, 0.7);
  w.spring(0, 1, 100, 0.5);
  w.spring(1, 3, 40, 1);
  w.pins({0});
  w.gravity({0, 0, -10});
  const auto x = hanging_equilibrium(w.scene("tree", 1, 0.01, 10));
  ASSERT_TRUE(x);
  const Vec3 first(0, 0, -0.5 - 27.5 / 100);
  EXPECT_LT((x->col(1) - first).norm(), 4 * eps);
  EXPECT_LT((x->col(2) - first - Vec3(0, 0, -0.7 - 2.5 / 10)).norm(), 8 * eps);
  EXPECT_LT((x->col(3) - first - Vec3(0, 0, -1 - 20. / 40)).norm(), 8 * eps);
}

TEST(HangingRest, IsNotClaimedElsewhere) {
  for (const auto name : {"normal-modes", "cloth-hang", "chain-link", "circle", "projectile"})
    EXPECT_FALSE(hanging_equilibrium(shipped_scene(name))) << name;
  Scene loop = shipped_scene("chain");  // a spring per free particle, but the last one is loose
  loop.model.find<Springs>()->list.back() = {0, 2, 100, 1, Family::single};
  EXPECT_FALSE(hanging_equilibrium(loop));
}

/// The chain with a drag rate of 3/s, released from the horizontal.
Scene damped_chain() { return with_drag(without_drag(shipped_scene("chain")), 3); }

TEST(HangingRest, IsWhereMysimComesToRest) {
  const Scene scene = damped_chain();
  const auto rest = hanging_equilibrium(scene);
  ASSERT_TRUE(rest);
  const double off = largest_column(scene.start.x - *rest), omega = highest_frequency(scene.model, scene.start);
  for (const Stepper& s : fixed_steppers()) {
    if (s.hard_constraints) continue;  // the equilibrium of Gauss-Seidel passes is different, see below
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {std::min(2e-3, 0.5 * s.limit(omega, 3)), 16, 8});
    for (int i = 0; i < t.frames(); ++i)
      // Every vibration is underdamped and decays as e^(-gamma t / 2). The factor of two is for its amplitude, which
      // drag makes larger than the initial displacement. Implicit rules leave 1e-12 of the forces, 4 N, on a swing with
      // a restoring stiffness of 1 N/m.
      EXPECT_LE(largest_column(t.x[i] - *rest), 2 * off * std::exp(-1.5 * t.t[i]) + 4e-12);
    // the rest lengths of the springs alone would not give this position
    EXPECT_GT(std::abs(t.x.back().col(3).norm() - scene.start.x.col(3).norm()), 1e-3);
  }
}

TEST(HangingRest, OneSweepAStepHangsLongerByTheSquareOfTheStep) {
  const Scene scene = damped_chain();
  const auto lower = [&](double h) {
    const Trajectory t = trajectory_of(stepper("xpbd"), scene, {h, 16, 1});
    return (*hanging_equilibrium(scene) - t.x.back())(1, 3);
  };
  // In each step, particles first fall freely by h^2 g / (1 + h gamma). One Gauss-Seidel pass propagates this fall from
  // link to link.
  const double coarse = lower(4e-3), fine = lower(2e-3);
  EXPECT_NEAR(slope(coarse, fine), 2, 0.02);  // the next order is smaller by h gamma = 0.01
  EXPECT_GT(fine, 2e-3 * 2e-3 * 9.81);
}

/// A flat cloth of n x n particles, 0.2 m apart, held along its edge, with springs stretched by a tenth. Each free
/// particle is displaced along `direction` by `amplitude` (m) times the product of two sines (a bump).
Scene flat_cloth(int n, double amplitude, const Vec3& direction, bool shear) {
  SceneWriter w;
  const double side = 0.2, stretch = 1.1;
  std::vector<int> edge;
  const auto at = [&](int i, int j) { return Vec3(side * i, 0, side * j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const bool held = i == 0 || j == 0 || i == n - 1 || j == n - 1;
      if (held) edge.push_back(i * n + j);
      const double bump = std::sin(std::numbers::pi * i / (n - 1)) * std::sin(std::numbers::pi * j / (n - 1));
      w.particle(at(i, j) + (held ? 0 : amplitude * bump) * direction, 0.1);
    }
  const auto join = [&](int i, int j, int k, int l) {
    if (k < n && l >= 0 && l < n) w.spring(i * n + j, k * n + l, 100, (at(i, j) - at(k, l)).norm() / stretch);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      join(i, j, i + 1, j), join(i, j, i, j + 1);
      if (shear) join(i, j, i + 1, j + 1), join(i, j, i + 1, j - 1);
    }
  w.pins(edge);
  return w.scene("sheet", 1, 1e-3, 40);
}

TEST(Linearised, FrequenciesOfAMembrane) {
  const int n = 6;
  const auto motion =
      linearised_solution(flat_cloth(n, 1e-3, Vec3(0, 1, 0), false), flat_cloth(n, 0, Vec3(0, 1, 0), false).start.x);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->omega.size(), 3u * (n - 2) * (n - 2));
  // out of the plane the stiffness is tension over length: omega^2 = 4 T / (m L) (sin^2 + sin^2)
  const double tension = 100 * (0.2 - 0.2 / 1.1);
  for (int p = 1; p < n - 1; ++p)
    for (int q = 1; q < n - 1; ++q) {
      const auto part = [&](int i) { return std::pow(std::sin(i * std::numbers::pi / (2 * (n - 1))), 2); };
      const double omega = 2 * std::sqrt(tension / (0.1 * 0.2) * (part(p) + part(q)));
      double nearest = INFINITY;
      for (const double each : motion->omega) nearest = std::min(nearest, std::abs(each - omega));
      EXPECT_LT(nearest, 1e-13 * motion->omega.back());  // a few hundred roundings of the largest eigenvalue
    }
}

/// Largest deviation, in and out of the plane, from the linearised motion over three periods of the slowest vibration,
/// relative to the amplitude.
struct Deviation {
  double in_plane, out_of_plane;
};
Deviation deviation(double amplitude, const Vec3& direction) {
  const Scene scene = flat_cloth(6, amplitude, direction, true);
  const auto motion = linearised_solution(scene, flat_cloth(6, 0, direction, true).start.x);
  const double until = 3 * 2 * std::numbers::pi / motion->omega.front();
  const Trajectory t = trajectory_of(stepper("suzuki4"), scene, {5e-4, until, 60});
  Deviation d{0, 0};
  for (int i = 0; i < t.frames(); ++i) {
    const Points off = t.x[i] - motion->at(t.t[i]).x;
    d.out_of_plane = std::max(d.out_of_plane, off.row(1).cwiseAbs().maxCoeff() / amplitude);
    d.in_plane = std::max(
        {d.in_plane, off.row(0).cwiseAbs().maxCoeff() / amplitude, off.row(2).cwiseAbs().maxCoeff() / amplitude});
  }
  return d;
}

TEST(Linearised, FailsAsThePowerOfTheAmplitudeThatItsSymmetryGives) {
  const Vec3 up(0, 1, 0), aside(1, 0, 0);
  const Deviation a = deviation(0.005, up), b = deviation(0.0025, up);
  const Deviation c = deviation(0.005, aside), d = deviation(0.0025, aside);
  // the next term is smaller by 0.02, the amplitude over the spring length of 0.2 m
  EXPECT_NEAR(slope(a.out_of_plane, b.out_of_plane), 2, 0.04);
  EXPECT_NEAR(slope(a.in_plane, b.in_plane), 1, 0.04);
  EXPECT_NEAR(slope(c.in_plane, d.in_plane), 1, 0.04);
  EXPECT_LT(c.out_of_plane, 1e-13);  // the cloth stays in the plane
  // amplitudes with a deviation of 1 %, as in tests/unit/reference/limits_of_motion.h (two digits)
  EXPECT_NEAR(deviation(0.011, up).out_of_plane, 0.01, 0.001);
  EXPECT_NEAR(deviation(0.0088, aside).in_plane, 0.01, 0.001);
}

TEST(Linearised, IsNotClaimedElsewhere) {
  const Vec3 up(0, 1, 0);
  const Scene flat = flat_cloth(6, 0, up, true);
  EXPECT_TRUE(linearised_solution(flat, flat.start.x));
  Scene slack = flat, pressed = flat, pulled = flat;
  for (Spring& s : slack.model.find<Springs>()->list) s.rest *= 1.1;  // at rest length: no transverse stiffness
  for (Spring& s : pressed.model.find<Springs>()->list) s.rest *= 1.2;
  EXPECT_FALSE(linearised_solution(slack, flat.start.x));
  EXPECT_FALSE(linearised_solution(pressed, flat.start.x));
  pulled.model.terms.emplace_back(Gravity{{0, -9.81, 0}});  // no equilibrium for the flat cloth
  EXPECT_FALSE(linearised_solution(pulled, flat.start.x));
  Scene moved = flat;
  moved.model.particles.move = Motion{up, 1, 1};
  EXPECT_FALSE(linearised_solution(moved, flat.start.x));
  EXPECT_FALSE(linearised_solution(shipped_scene("chain-link"), shipped_scene("chain-link").start.x));
  // nor may it be claimed as a reference solution
  EXPECT_FALSE(exact_solution(flat_cloth(6, 1e-3, up, true)));
}

TEST(Linearised, AgreesWithTheExactModesOfAStretchedChain) {
  // Along the line the linearisation is exact.
  const Scene scene = shipped_scene("normal-modes");
  Scene resting = scene;
  for (int i = 0; i < 10; ++i) resting.start.x(0, i) = 0.275 * i;
  const auto motion = linearised_solution(scene, resting.start.x);
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(motion && exact);
  // phases reach 120 rad (60 rad/s for 2 s), and each frequency is rounded by some eps of the largest eigenvalue
  for (double t = 0; t < 2; t += 0.1) EXPECT_LT((motion->at(t).x - exact->at(t).x).norm(), 1e-12) << t;
}

TEST(Linearised, HangingChainSwingsAsTheLimitSays) {
  // motion about the equilibrium of hanging_equilibrium(), displaced by 1e-4 m
  Scene scene = damped_chain();
  const Points rest = *hanging_equilibrium(scene);
  scene.start.x = rest;
  scene.start.x(0, 3) += 1e-4;
  const auto motion = linearised_solution(scene, rest);
  ASSERT_TRUE(motion);
  const Trajectory t = trajectory_of(stepper("rk4"), scene, {1e-3, 3, 30});
  for (int i = 0; i < t.frames(); ++i)
    // neglected terms are of second order, 1e-8 m^2 over a link of 0.5 m
    EXPECT_LT(largest_column(t.x[i] - motion->at(t.t[i]).x), 1e-8 / 0.5);
}

}  // namespace
}  // namespace crosscheck
