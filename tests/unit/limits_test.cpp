// What scenes tend to: the shape of rest as time goes on, the linearised motion as the amplitude falls.
#include <numbers>

#include "experiments/scenes.h"
#include "mysim/frequency.h"
#include "reference/exact/exact.h"
#include "tests/unit/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(HangingRest, CarriesTheWeightBelow) {
  SceneWriter w;  // a chain of two with a branch at the first
  w.particle({0, 0, 0}, 1);
  w.particle({1, 0, 0}, 0.5);
  w.particle({2, 0, 0}, 0.25);
  w.particle({1, 1, 0}, 2);
  w.spring(2, 1, 10, 0.7);
  w.spring(0, 1, 100, 0.5);
  w.spring(1, 3, 40, 1);
  w.pins({0});
  w.gravity({0, 0, -10});
  const auto x = hanging_rest(w.scene("tree", 1, 0.01, 10));
  ASSERT_TRUE(x);
  const Vec3 first(0, 0, -0.5 - 27.5 / 100);
  EXPECT_LT((x->col(1) - first).norm(), 4 * eps);
  EXPECT_LT((x->col(2) - first - Vec3(0, 0, -0.7 - 2.5 / 10)).norm(), 8 * eps);
  EXPECT_LT((x->col(3) - first - Vec3(0, 0, -1 - 20. / 40)).norm(), 8 * eps);
}

TEST(HangingRest, IsNotClaimedElsewhere) {
  for (const auto name : {"normal-modes", "cloth-hang", "chain-link", "circle", "projectile"})
    EXPECT_FALSE(hanging_rest(load_scene(name))) << name;
  Scene loop = load_scene("chain");  // as many springs, but the last particle is loose
  loop.model.find<Springs>()->list.back() = {0, 2, 100, 1, Family::single};
  EXPECT_FALSE(hanging_rest(loop));
}

/// The chain with a drag of 3/s, let go from the horizontal.
Scene damped_chain() { return with_drag(without_drag(load_scene("chain")), 3); }

TEST(HangingRest, IsWhereMysimComesToRest) {
  const Scene scene = damped_chain();
  const auto rest = hanging_rest(scene);
  ASSERT_TRUE(rest);
  const double off = largest_column(scene.start.x - *rest), omega = fastest_frequency(scene.model, scene.start);
  for (const Stepper& s : fixed_steppers()) {
    if (s.hard_constraints) continue;  // sweeps come to rest elsewhere, see below
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {std::min(2e-3, 0.5 * s.limit(omega, 3)), 16, 8});
    for (int i = 0; i < t.frames(); ++i)
      // every vibration is underdamped and falls as e^(-gamma t / 2), with twice the start for what drag adds to it at
      // first; implicit rules leave 1e-12 of the forces, 4 N, on a swing that 1 N/m brings back
      EXPECT_LE(largest_column(t.x[i] - *rest), 2 * off * std::exp(-1.5 * t.t[i]) + 4e-12);
    // the lengths of the springs alone are not it
    EXPECT_GT(std::abs(t.x.back().col(3).norm() - scene.start.x.col(3).norm()), 1e-3);
  }
}

TEST(HangingRest, OneSweepAStepHangsLongerByTheSquareOfTheStep) {
  const Scene scene = damped_chain();
  const auto lower = [&](double h) {
    const Trajectory t = trajectory_of(stepper("xpbd"), scene, {h, 16, 1});
    return (*hanging_rest(scene) - t.x.back())(1, 3);
  };
  // each step falls freely by h^2 g / (1 + h gamma) first, which one sweep hands on from link to link
  const double coarse = lower(4e-3), fine = lower(2e-3);
  EXPECT_NEAR(slope(coarse, fine), 2, 0.02);  // the next order is h gamma = 0.01
  EXPECT_GT(fine, 2e-3 * 2e-3 * 9.81);
}

/// A flat sheet of n x n particles, 0.2 m apart, held along its edge, its springs stretched by a tenth; each free
/// particle is moved by amplitude (m) times the bump sin sin, in the direction.
Scene sheet(int n, double amplitude, const Vec3& direction, bool shear) {
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
      linearised_solution(sheet(n, 1e-3, Vec3(0, 1, 0), false), sheet(n, 0, Vec3(0, 1, 0), false).start.x);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->omega.size(), 3u * (n - 2) * (n - 2));
  // out of the plane each spring pulls with tension / length: omega^2 = 4 T / (m L) (sin^2 + sin^2)
  const double tension = 100 * (0.2 - 0.2 / 1.1);
  for (int p = 1; p < n - 1; ++p)
    for (int q = 1; q < n - 1; ++q) {
      const auto part = [&](int i) { return std::pow(std::sin(i * std::numbers::pi / (2 * (n - 1))), 2); };
      const double omega = 2 * std::sqrt(tension / (0.1 * 0.2) * (part(p) + part(q)));
      double nearest = INFINITY;
      for (const double each : motion->omega) nearest = std::min(nearest, std::abs(each - omega));
      EXPECT_LT(nearest, 1e-13 * motion->omega.back());  // some hundred roundings of the largest eigenvalue
    }
}

/// Largest deviation from the linearised motion over three periods of the slowest vibration, over the amplitude: in the
/// plane and out of it.
struct Deviation {
  double in_plane, out_of_plane;
};
Deviation deviation(double amplitude, const Vec3& direction) {
  const Scene scene = sheet(6, amplitude, direction, true);
  const auto motion = linearised_solution(scene, sheet(6, 0, direction, true).start.x);
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
  // the next term is less by a power of the amplitude over the 0.2 m of a spring, 0.02
  EXPECT_NEAR(slope(a.out_of_plane, b.out_of_plane), 2, 0.04);
  EXPECT_NEAR(slope(a.in_plane, b.in_plane), 1, 0.04);
  EXPECT_NEAR(slope(c.in_plane, d.in_plane), 1, 0.04);
  EXPECT_LT(c.out_of_plane, 1e-13);  // it never leaves the plane
  // where it is 1 % off, as exact.h says to two digits
  EXPECT_NEAR(deviation(0.011, up).out_of_plane, 0.01, 0.001);
  EXPECT_NEAR(deviation(0.0088, aside).in_plane, 0.01, 0.001);
}

TEST(Linearised, IsNotClaimedElsewhere) {
  const Vec3 up(0, 1, 0);
  const Scene flat = sheet(6, 0, up, true);
  EXPECT_TRUE(linearised_solution(flat, flat.start.x));
  Scene slack = flat, pressed = flat, pulled = flat;
  for (Spring& s : slack.model.find<Springs>()->list) s.rest *= 1.1;  // as long as at rest: no stiffness upwards
  for (Spring& s : pressed.model.find<Springs>()->list) s.rest *= 1.2;
  EXPECT_FALSE(linearised_solution(slack, flat.start.x));
  EXPECT_FALSE(linearised_solution(pressed, flat.start.x));
  pulled.model.terms.emplace_back(Gravity{{0, -9.81, 0}});  // the flat sheet is then no equilibrium
  EXPECT_FALSE(linearised_solution(pulled, flat.start.x));
  Scene moved = flat;
  moved.model.particles.move = Motion{up, 1, 1};
  EXPECT_FALSE(linearised_solution(moved, flat.start.x));
  EXPECT_FALSE(linearised_solution(load_scene("chain-link"), load_scene("chain-link").start.x));
  // and it is nobody's truth
  EXPECT_FALSE(exact_solution(sheet(6, 1e-3, up, true)));
}

TEST(Linearised, AgreesWithTheExactModesOfAStretchedChain) {
  // along the line nothing is left out: the limit is the solution
  const Scene scene = load_scene("normal-modes");
  Scene resting = scene;
  for (int i = 0; i < 10; ++i) resting.start.x(0, i) = 0.275 * i;
  const auto motion = linearised_solution(scene, resting.start.x);
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(motion && exact);
  // 60 rad/s for 2 s from eigenvalues rounded by some eps of the largest
  for (double t = 0; t < 2; t += 0.1) EXPECT_LT((motion->at(t).x - exact->at(t).x).norm(), 1e-12) << t;
}

TEST(Linearised, HangingChainSwingsAsTheLimitSays) {
  // about the shape of rest that hanging_rest gives, 1e-4 m aside
  Scene scene = damped_chain();
  const Points rest = *hanging_rest(scene);
  scene.start.x = rest;
  scene.start.x(0, 3) += 1e-4;
  const auto motion = linearised_solution(scene, rest);
  ASSERT_TRUE(motion);
  const Trajectory t = trajectory_of(stepper("rk4"), scene, {1e-3, 3, 30});
  for (int i = 0; i < t.frames(); ++i)
    // what is left out is of second order, 1e-8 m^2 over a link of 0.5 m
    EXPECT_LT(largest_column(t.x[i] - motion->at(t.t[i]).x), 1e-8 / 0.5);
}

}  // namespace
}  // namespace crosscheck
