// Whole runs: momentum, angular momentum, and invariance under rotations and translations, for every stepper.

#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// A free network without external forces, with or without dashpots.
Network free_network(unsigned seed, bool dashpots) {
  Network net = random_network(seed);
  std::erase_if(net.model.terms, [](const Term& t) { return std::holds_alternative<Gravity>(t); });
  const Dashpots list = random_dashpots(seed, net);
  if (dashpots) net.model.terms.emplace_back(list);
  return net;
}

/// Largest changes in a run of momentum (kg m/s) and of angular momentum about the origin (kg m^2/s).
struct Changes {
  double momentum = 0, angular = 0;
};
Changes changes_in(const Stepper& s, const Scene& scene, const Run& run) {
  const Trajectory t = trajectory_of(s, scene, run);
  Changes changes;
  Vec3 momentum_0, angular_0;
  for (int i = 0; i < t.frames(); ++i) {
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (int p = 0; p < t.x[i].cols(); ++p) {
      const Vec3 mv = scene.model.particles.mass[p] * t.v[i].col(p);
      momentum += mv;
      angular += Vec3(t.x[i].col(p)).cross(mv);
    }
    if (i == 0) momentum_0 = momentum, angular_0 = angular;
    changes.momentum = std::max(changes.momentum, (momentum - momentum_0).norm());
    changes.angular = std::max(changes.angular, (angular - angular_0).norm());
  }
  return changes;
}

/// Residual force (N) in each step. For implicit rules it is at most 1e-10 of the largest force, the inertia m v / (h /
/// 2) of 2 kg at up to 20 m/s. For explicit rules it is the rounding of forces up to 500 N.
double force_left(const Stepper& s, double h) { return s.evaluations == 0 ? 1e-10 * 2 * 20 / (h / 2) : 32 * eps * 500; }

TEST(Runs, KeepTheMomentumOfFreeBodies) {
  const double h = 1e-3;
  const crosscheck::Run run{h, 0.5, 10};
  for (const Stepper& s : steppers())
    for (const bool dashpots : {false, true})
      for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(fmt::format("{} seed {} dashpots {}", s.name, seed, dashpots));
        // Forces of each pair cancel in every stage. The rest is the residual force on six particles for 0.5 s, and the
        // rounding of velocities up to 20 m/s in 500 steps.
        EXPECT_LT(changes_in(s, scene_of(free_network(seed, dashpots)), run).momentum,
                  6 * force_left(s, h) * 0.5 + 500 * 6 * 2 * 20 * eps);
      }
}

TEST(Runs, KeepAngularMomentumWhereTheRuleIsSymplecticAndToItsOrderElsewhere) {
  for (const Stepper& s : fixed_steppers())
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", s.name, seed));
      const Scene scene = scene_of(free_network(seed, false));
      const double h = 1e-3;
      const double coarse = changes_in(s, scene, {h, 0.5, 10}).angular;
      // These symplectic rules alternate drifts along v and kicks by central forces. Both conserve angular momentum.
      // Residual forces act with lever arms of up to 5 m.
      const double kept = 5 * (6 * force_left(s, h) * 0.5 + 500 * 6 * 2 * 20 * eps);
      if (s.symplectic) {
        EXPECT_LT(coarse, kept);
        continue;
      }
      // other rules change angular momentum by at most the error of their order
      EXPECT_GT(coarse, kept / 100);
      const double fine = changes_in(s, scene, {h / 2, 0.5, 10}).angular;
      EXPECT_TRUE(coarse < kept || slope(coarse, fine) > s.order - 0.3) << slope(coarse, fine);
    }
}

/// The scene rotated about the origin and then translated, including everything in it that has a direction.
Scene turned(Scene scene, const Eigen::Matrix3d& turn, const Vec3& shift) {
  scene.start.x = ((turn * scene.start.x).colwise() + shift).eval();
  scene.start.v = (turn * scene.start.v).eval();
  Particles& p = scene.model.particles;
  p.pin_home = ((turn * p.pin_home).colwise() + shift).eval();
  if (p.move) p.move->amplitude = (turn * p.move->amplitude).eval();
  auto turn_blowing = [&](WindSignal& b) {
    b.mean = (turn * b.mean).eval();
    if (b.gusts) b.gusts->side = (turn * b.gusts->side).eval();
  };
  for (Term& term : scene.model.terms) {
    if (auto* gravity = std::get_if<Gravity>(&term)) gravity->acceleration = (turn * gravity->acceleration).eval();
    if (auto* wind = std::get_if<Wind>(&term)) turn_blowing(wind->acceleration);
    if (auto* air = std::get_if<Aerodynamics>(&term)) turn_blowing(air->velocity);
  }
  return scene;
}

TEST(Runs, DoNotDependOnDirectionOrPlace) {
  const double h = 1e-3, duration = 0.1;
  const crosscheck::Run run{h, duration, 5};
  // An adaptive rule measures errors along the axes of the scene, so rotation changes its steps within the tolerance.
  for (const Stepper& s : fixed_steppers())
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", s.name, seed));
      Network net = busy_network(seed);
      net.model.terms.emplace_back(random_air(seed));
      const Scene scene = scene_of(net);
      Random random(seed + 300);
      const Eigen::Matrix3d turn = random_turn(random);
      const Vec3 shift = random.vector();
      const Trajectory here = trajectory_of(s, scene, run), there = trajectory_of(s, turned(scene, turn, shift), run);
      double apart = 0;
      for (int i = 0; i < here.frames(); ++i)
        apart = std::max(apart, (((turn * here.x[i]).colwise() + shift) - there.x[i]).cwiseAbs().maxCoeff());
      // The bound is the effect of the residual force on 0.1 kg during the whole time, plus 8 ulps of 3 m per step;
      // both grow at most tenfold in 0.1 s.
      EXPECT_LT(apart, 10 * (2 * force_left(s, h) / 0.1 * duration * duration / 2 + 8 * 3 * eps * duration / h));
    }
}

}  // namespace
}  // namespace crosscheck
