// Closed forms with contact or by modes satisfy their own laws; mysim converges to them; other scenes are refused.

#include <Eigen/Geometry>

#include <numbers>

#include "mysim/model/system.h"
#include "reference/truth/exact/exact.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Largest distance (m) from the closed form at any sample up to `until`.
double off(const Scene& scene, const ExactSolution& exact, const std::string& method, double h, double until) {
  const int samples = 50;
  const Trajectory t = trajectory_of(stepper(method), scene, {h, until, samples});
  double worst = 0;
  for (int i = 0; i < t.frames(); ++i)
    worst = std::max(worst, (t.x[i] - exact.at(t.t[i]).x).colwise().norm().maxCoeff());
  return worst;
}

TEST(Bounces, ReturnTheSquareOfRestitutionAndEndInRest) {
  const Scene scene = shipped_scene("bounce");
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  const double drop = 0.3, g = 9.81, fall = std::sqrt(2 * drop / g);
  const double restitution[] = {0, 0.5, 0.9};
  for (int i = 0; i < 3; ++i) {
    const double e = restitution[i];
    if (e == 0) {
      EXPECT_NEAR(exact->at(1.001 * fall).x(1, i), 0, eps);
      EXPECT_EQ(exact->at(1.001 * fall).v(1, i), 0);
      continue;
    }
    // half way through the first rebound: the flight takes 2 e times the fall
    const State top = exact->at(fall + e * fall);
    EXPECT_NEAR(top.x(1, i), e * e * drop, 8 * eps) << e;
    EXPECT_NEAR(top.v(1, i), 0, 16 * eps) << e;
    if (e > 0.5) continue;
    // total time of all bounces: fall (1 + e) / (1 - e); then the particle rests
    const double end = fall * (1 + e) / (1 - e);
    EXPECT_GT(exact->at(0.99 * end).x(1, i) + std::abs(exact->at(0.99 * end).v(1, i)), 0);
    EXPECT_NEAR(exact->at(1.01 * end).x(1, i), 0, eps);
    EXPECT_EQ(exact->at(1.01 * end).v(1, i), 0);
  }
}

TEST(Bounces, KeepEnergyBetweenImpacts) {
  const auto exact = exact_solution(shipped_scene("bounce"));
  for (double t = 0; t < 2; t += 0.0137) {
    const State s = exact->at(t);
    for (int i = 0; i < 3; ++i) {
      const double energy = s.x(1, i) * 9.81 + s.v(1, i) * s.v(1, i) / 2, start = 0.3 * 9.81;
      EXPECT_LE(energy, start * (1 + 8 * eps));
      EXPECT_GE(s.x(1, i), -8 * eps);
      // the energy left is the initial one times a power of e^2
      const double e = i == 1 ? 0.5 : 0.9, impacts = std::log(energy / start) / std::log(e * e);
      if (i > 0 && energy > 1e-3) {
        EXPECT_NEAR(impacts, std::round(impacts), 1e-9);  // a logarithm, exact to some ulps
      }
    }
  }
}

TEST(Slide, SatisfiesCoulombsLawOnTheBallAndFliesFreelyAfterwards) {
  const Scene scene = shipped_scene("slide");
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  const Sphere& ball = scene.model.find<Spheres>()->list[0];
  const double radius = ball.contact_radius(), dt = std::cbrt(eps) / 3;  // s; u'/u is about 3 /s
  const Vec3 g(0, -9.81, 0);
  bool left = false;
  for (double t = 0.01; t < 0.99; t += 0.01) {
    const State s = exact->at(t), up = exact->at(t + dt), down = exact->at(t - dt);
    const Vec3 d = s.x.col(0) - ball.centre, n = d.normalized(), v = s.v.col(0);
    const Vec3 a = (up.v.col(0) - down.v.col(0)) / (2 * dt);
    EXPECT_LT(((up.x.col(0) - down.x.col(0)) / (2 * dt) - v).norm(), 1e-8);  // eps^(2/3) times some m/s^3
    if (d.norm() < radius * (1 + 1e-12)) {
      EXPECT_FALSE(left);
      // Force of the ball: its normal component must not pull, and friction is mu times the normal force, against the
      // motion.
      const Vec3 force = a - g;
      const double normal = force.dot(n), along = force.dot(v.normalized());
      EXPECT_GT(normal, -1e-6);
      EXPECT_NEAR(along, -ball.friction * normal, 1e-8);
    } else if ((exact->at(t - dt).x.col(0) - ball.centre).norm() > radius * (1 + 1e-12)) {
      left = true;
      EXPECT_LT((a - g).norm(), 1e-8);
    }
  }
  EXPECT_TRUE(left);
}

TEST(Slide, WithoutFrictionItLeavesWhereEnergySays) {
  Scene scene = shipped_scene("slide");
  scene.model.find<Spheres>()->list[0].friction = 0;
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  // v^2 = v0^2 + 2 g R (1 - cos), and the particle leaves at v^2 = g R cos: cos = (2 + v0^2 / (g R)) / 3
  const double radius = 1.02, cosine = (2 + 1 / (9.81 * radius)) / 3;
  double low = 0, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (exact->at(middle).x.col(0).norm() > radius * (1 + 1e-13) ? high : low) = middle;
  }
  // After departure, the gap to the ball grows as the cube of the time. At 2.6 m/s on a ball of 1 m, it reaches 1e-13
  // of the radius after 5e-5 s.
  EXPECT_NEAR(exact->at(low).x(1, 0) / radius, cosine, 2e-4);
}

TEST(ContactExact, MysimConvergesToTheClosedForms) {
  for (const auto name : {"slide", "bounce"}) {
    const Scene scene = shipped_scene(name);
    const auto exact = exact_solution(scene);
    for (const auto method : {"leapfrog", "rk4", "symplectic-euler"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      const double until = std::string_view(name) == "bounce" ? 0.6 : 1;
      const double coarse = off(scene, *exact, method, 1e-3, until), fine = off(scene, *exact, method, 1e-5, until);
      // At first order, the short step has a hundredth of the error, or up to four times as much, depending on where in
      // its step an impact occurs.
      EXPECT_LT(fine, 0.04 * coarse);
      EXPECT_LT(coarse, 2 * 3 * 1e-3 * 4);  // distance moved in a few steps at 3 m/s
    }
  }
}

/// A particle at rest on a ball, 20 degrees from its top; friction is `part` times the tangent of that angle.
Scene held(double part, const std::string& more = "") {
  const double angle = 20 * std::numbers::pi / 180;
  return small_scene(
      fmt::format("[[particle]]\nposition = [{}, {}, 0]\nmass = 2\n{}[sphere]\ncentre = [0, 0, 0]\n"
                  "radius = 1\nfriction = {}\n{}",
                  std::sin(angle), std::cos(angle), gravity_text, part * std::tan(angle), more));
}

TEST(FrictionHold, StaysWithinTheConeAndIsNotClaimedOutside) {
  EXPECT_FALSE(exact_solution(held(0.999)));
  for (const auto more : {"", "[drag]\ngamma = 1\n", "[wind]\nacceleration = [-0.1, 0, 0]\n"}) {
    const Scene scene = held(1.001, more);
    const auto exact = exact_solution(scene);
    ASSERT_TRUE(exact) << more;
    EXPECT_EQ(exact->at(5).x, scene.start.x);
    // a wind along the slope drives the particle out of the friction cone
    EXPECT_FALSE(exact_solution(held(1.001, "[wind]\nacceleration = [0.1, 0, 0]\n")));
  }
  Scene moving = held(1.001);
  moving.start.v(2, 0) = 1e-3;
  EXPECT_FALSE(exact_solution(moving));
  Scene above = held(1.001);
  above.start.x *= 1.001;  // it falls first
  EXPECT_FALSE(exact_solution(above));
  Scene below = held(2);
  below.start.x *= -1;  // no normal force
  EXPECT_FALSE(exact_solution(below));
  Scene wedged = held(1.001);
  wedged.model.find<Spheres>()->list.push_back({2 * wedged.start.x.col(0), 1, 0, 0.5, 0, {}});
  EXPECT_FALSE(exact_solution(wedged));
}

TEST(FrictionHold, MysimHoldsIt) {
  for (const auto method : {"explicit-euler", "trapezoidal", "rk4", "symplectic-euler", "leapfrog"}) {
    const Scene in = held(1.01), out = held(0.99);
    // Each step puts the particle back on the surface to a few roundings of 1 m. Friction removes the rest of its
    // motion.
    EXPECT_LT(off(in, *exact_solution(in), method, 1e-3, 1), 1000 * 4 * eps) << method;
    // outside the cone, the particle moves by g (sin - mu cos) t^2 / 2 = g sin / 200
    EXPECT_GT(off(out, *exact_solution(in), method, 1e-3, 1), 0.5 * 9.81 * 0.342 / 200) << method;
  }
}

TEST(ContactExact, IsNotClaimedElsewhere) {
  Scene moved = shipped_scene("bounce");
  moved.start.x(0, 1) += 1e-6;  // off the axis, so that the particle is deflected sideways
  EXPECT_FALSE(exact_solution(moved));
  Scene dragged = with_drag(shipped_scene("bounce"), 1);
  EXPECT_FALSE(exact_solution(dragged));
  Scene carried = shipped_scene("bounce");
  carried.model.find<Spheres>()->list[0].motion = Motion{{0, 0.1, 0}, 1, 1};
  EXPECT_FALSE(exact_solution(carried));
  Scene stopped = shipped_scene("slide");
  stopped.model.find<Spheres>()->list[0].friction = 0.8;  // stops on the ball
  EXPECT_FALSE(exact_solution(stopped));
  Scene sideways = shipped_scene("slide");
  sideways.start.x.col(0) = 1.02 * Vec3(std::sin(0.3), std::cos(0.3), 0);
  sideways.start.v.col(0) = Vec3(0, 0, 1);  // not in the plane of gravity
  EXPECT_FALSE(exact_solution(sideways));
}

TEST(NormalModes, FrequenciesAreThoseOfTheChain) {
  const Scene scene = shipped_scene("normal-modes");
  // omega_j = 2 sqrt(k/m) sin(j pi / (2 (n + 1))): the fastest of eight
  const double fastest = 2 * std::sqrt(100 / 0.1) * std::sin(8 * std::numbers::pi / 18);
  EXPECT_NEAR(highest_frequency(scene.model, scene.start) / fastest, 1, 2e-3);  // power iteration stops at 1e-5
  // a single mode returns after its period
  Scene first = scene;
  for (int i = 1; i <= 8; ++i) first.start.x(0, i) = 0.275 * i + 0.01 * std::sin(i * std::numbers::pi / 9);
  const auto exact = exact_solution(first);
  ASSERT_TRUE(exact);
  const double period = 2 * std::numbers::pi / (2 * std::sqrt(1000.0) * std::sin(std::numbers::pi / 18));
  EXPECT_LT((exact->at(period).x - first.start.x).norm(), 1e-13);  // a few hundred roundings of 2.5 m
  EXPECT_GT((exact->at(period / 2).x - first.start.x).norm(), 0.02);
}

TEST(NormalModes, AreRefusedWhereSpringsAreNotLinear) {
  Scene bent = shipped_scene("normal-modes");
  bent.start.x(1, 3) += 1e-6;
  EXPECT_FALSE(exact_solution(bent));
  Scene linked = shipped_scene("normal-modes");
  linked.model.find<Springs>()->law = SpringLaw::bullet_link;
  EXPECT_FALSE(exact_solution(linked));
  Scene wild = shipped_scene("normal-modes");
  wild.start.v(0, 4) = 20;  // would hit its neighbour
  EXPECT_FALSE(exact_solution(wild));
  Scene loose = shipped_scene("normal-modes");
  loose.model.particles.pins.clear();
  loose.model.particles.pinned.assign(10, 0);  // without pins there is no equilibrium
  EXPECT_FALSE(exact_solution(loose));
}

}  // namespace
}  // namespace crosscheck
