// Hard distances: XPBD satisfies them to second order and reproduces the period of the rigid pendulum. The solution
// with Lagrange multipliers conserves distances, period and energy. Other integrators refuse hard distances.

#include <Eigen/Dense>

#include <numbers>

#include "mysim/base/errors.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/multipliers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/limits_of_motion.h"

namespace crosscheck {

namespace {

using namespace testing_tools;

/// A rope of equal links, held at the origin, released at the angle (rad) from the vertical.
Scene rope(int links, double length, double angle, double duration = 1) {
  std::string text;
  for (int i = 0; i <= links; ++i)
    text += fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 0.1\n",
                        i * length / links * std::sin(angle), -i * length / links * std::cos(angle));
  for (int i = 0; i < links; ++i) text += fmt::format("[[constraint]]\nends = [{}, {}]\n", i, i + 1);
  return small_scene(text + "[pins]\nparticles = [0]\n" + gravity_text, duration);
}

std::vector<Stepper> hard_steppers() {
  std::vector<Stepper> list;
  for (const Stepper& s : steppers())
    if (s.hard_constraints) list.push_back(s);
  EXPECT_FALSE(list.empty());
  return list;
}

TEST(HardDistances, AreKeptToSecondOrder) {
  const Scene scene = rope(10, 1, std::numbers::pi / 2);
  for (const Stepper& s : hard_steppers()) {
    double before = 0;
    for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4}) {
      const Trajectory t = trajectory_of(s, scene, {h, 1, 100});
      double worst = 0;
      for (const Points& x : t.x)
        worst = std::max(worst, largest_constraint_error(*scene.model.find<Constraints>(), x));
      fmt::print("rope of ten links, h = {}: stretched by {:.3g}\n", h, worst);
      // One Gauss-Seidel pass per step leaves an error as large as the transverse motion in a step: h^2 times an
      // acceleration, divided by a link's length. This is of second order, but the moment at which the whip reaches its
      // maximum depends on the step.
      if (before > 0) {
        EXPECT_NEAR(slope(before, worst), 2, 0.5);
      }
      before = worst;
    }
    EXPECT_LT(before, 1e-3);
  }
}

TEST(HardDistances, APendulumHasTheRigidPeriodToFirstOrder) {
  const double length = 1, angle = std::numbers::pi / 3, period = rigid_pendulum_period(length, 9.81, angle);
  const Scene scene = rope(1, length, angle, 3);
  auto error = [&](const Stepper& s, double h) {
    // time between two passages of the vertical in the same direction, sampled at every step
    const int steps = static_cast<int>(std::lround(3 / h));
    const Trajectory t = trajectory_of(s, scene, {h, 3, steps});
    std::vector<double> passages;
    for (int i = 1; i < t.frames(); ++i)
      if (t.x[i - 1](0, 1) > 0 && t.x[i](0, 1) <= 0)
        passages.push_back(t.t[i - 1] + h * t.x[i - 1](0, 1) / (t.x[i - 1](0, 1) - t.x[i](0, 1)));
    EXPECT_EQ(passages.size(), 2u);
    return passages.size() == 2 ? std::abs(passages[1] - passages[0] - period) : NAN;
  };
  for (const Stepper& s : hard_steppers()) {
    const double coarse = error(s, 2e-3), fine = error(s, 1e-3);
    fmt::print("{}: period off by {:.3g} s and {:.3g} s of {:.6g} s\n", s.name, coarse, fine, period);
    // Numerical damping is h omega^2 / 2: 1 % of the amplitude per swing at 1e-3 s. The period decreases by theta^2 / 8
    // = 0.14 times this percentage, i.e. by a relative 1.5e-3, plus elliptic corrections.
    EXPECT_LT(fine, 3e-3 * period);
    EXPECT_NEAR(slope(coarse, fine), 1, 0.3);
  }
}

/// The rope's motion by Lagrange multipliers, from the distances differentiated twice: (J M^-1 J^T) lambda = J M^-1 f +
/// J' v, M v' = f - J^T lambda. Uses rk4 with a dense solve.
class RopeByMultipliers {
 public:
  explicit RopeByMultipliers(const Scene& scene) : scene_(scene) {}
  Trajectory run(double h, double duration, int samples) const {
    Trajectory t;
    Points x = scene_.start.x, v = scene_.start.v;
    const int per_sample = static_cast<int>(std::lround(duration / samples / h));
    for (int n = 0; n <= per_sample * samples; ++n) {
      if (n % per_sample == 0) t.t.push_back(n * h), t.x.push_back(x), t.v.push_back(v);
      const Points k1x = v, k1v = rate(x, v);
      const Points k2x = v + h / 2 * k1v, k2v = rate(x + h / 2 * k1x, k2x);
      const Points k3x = v + h / 2 * k2v, k3v = rate(x + h / 2 * k2x, k3x);
      const Points k4x = v + h * k3v, k4v = rate(x + h * k3x, k4x);
      x += h / 6 * (k1x + 2 * k2x + 2 * k3x + k4x);
      v += h / 6 * (k1v + 2 * k2v + 2 * k3v + k4v);
    }
    return t;
  }

 private:
  Points rate(const Points& x, const Points& v) const {
    const auto& list = scene_.model.find<Constraints>()->list;
    const Particles& p = scene_.model.particles;
    const int m = static_cast<int>(list.size()), n = p.size();
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(m, 3 * n);
    Eigen::VectorXd turning(m), inverse_mass(3 * n), force(3 * n);
    for (int i = 0; i < n; ++i) {
      inverse_mass.segment<3>(3 * i).setConstant(p.pinned[i] ? 0 : 1 / p.mass[i]);
      force.segment<3>(3 * i) = p.mass[i] * scene_.model.find<Gravity>()->acceleration;
    }
    for (int c = 0; c < m; ++c) {  // gradient of |x_a - x_b|^2 / 2
      const Vec3 d = x.col(list[c].a) - x.col(list[c].b), dv = v.col(list[c].a) - v.col(list[c].b);
      j.block<1, 3>(c, 3 * list[c].a) = d.transpose();
      j.block<1, 3>(c, 3 * list[c].b) = -d.transpose();
      turning[c] = dv.squaredNorm();
    }
    const Eigen::MatrixXd weighted = j * inverse_mass.asDiagonal();
    const Eigen::VectorXd lambda = (weighted * j.transpose()).ldlt().solve(weighted * force + turning);
    const Eigen::VectorXd a = inverse_mass.cwiseProduct(force - j.transpose() * lambda);
    return Eigen::Map<const Points>(a.data(), 3, n);
  }
  const Scene& scene_;
};

TEST(HardDistances, ConvergeToTheEquationsWithMultipliersInFirstOrder) {
  const Scene scene = rope(4, 1, std::numbers::pi / 2);
  const double duration = 0.6;
  const int samples = 12;
  const RopeByMultipliers rope_by_multipliers(scene);
  const Trajectory truth = rope_by_multipliers.run(1e-3, duration, samples);
  // The reference is of order 4 and keeps its distances: compare a step of 1e-3 s with half this step.
  EXPECT_LT(sup_rms(truth, rope_by_multipliers.run(5e-4, duration, samples)), 1e-8);
  for (const Points& x : truth.x) EXPECT_LT(largest_constraint_error(*scene.model.find<Constraints>(), x), 1e-7);
  for (const Stepper& s : hard_steppers()) {
    double before = 0;
    for (const double h : {4e-4, 2e-4, 1e-4, 5e-5}) {
      const double error = sup_rms(trajectory_of(s, scene, {h, duration, samples}), truth);
      fmt::print("rope of four links, h = {}: {:.3g} m off\n", h, error);
      if (before > 0) {
        EXPECT_NEAR(slope(before, error), 1, 0.15);  // the next term is h times the whip's rate of 100/s
      }
      before = error;
    }
  }
}

TEST(HardDistances, AreRefusedByRulesThatKnowForcesOnly) {
  const Scene scene = rope(2, 1, 1);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    Recorder r;
    if (s.hard_constraints) {
      EXPECT_NO_THROW(simulate(s, ContactRule::coulomb, scene, {1e-3, 0.1, 1}, r));
      continue;
    }
    try {
      simulate(s, ContactRule::coulomb, scene, {1e-3, 0.1, 1}, r);
      ADD_FAILURE();
    } catch (const Unsupported& refusal) {
      EXPECT_TRUE(contains(refusal.what(), "hard distances"));
    }
    const MethodRun a = run_and_record("mysim/" + std::string(s.name), scene, {1e-3, 0.1, 1});
    EXPECT_EQ(a.outcome.verdict, Verdict::unsupported);
  }
}

TEST(HardDistances, EndsThatMeetAreCountedAndFinite) {
  // two ends meet in exactly representable steps
  const Scene scene = small_scene(
      "[[particle]]\nposition = [-1, 0, 0]\nmass = 1\nvelocity = [4, 0, 0]\n"
      "[[particle]]\nposition = [1, 0, 0]\nmass = 1\nvelocity = [-4, 0, 0]\n[[constraint]]\nends = [0, 1]\n",
      1, 0.25, 1);
  for (const Stepper& s : hard_steppers()) {
    Recorder r;
    const Outcome out = simulate(s, ContactRule::coulomb, scene, {0.25, 1, 1}, r);
    EXPECT_GE(out.degenerate_springs, 1);
    EXPECT_TRUE(r.trajectory.x.back().allFinite());
  }
}

TEST(Xpbd, OneSpringUnderDragIsImplicitEuler) {
  // Along its line a spring is linear, so the linearised step of one pass is the full step.
  Scene scene = with_drag(shipped_scene("spring"), 3);
  for (const double h : {1e-3, 1e-2, 0.1}) {
    const crosscheck::Run run{h, 1, 10};
    const Trajectory one = trajectory_of(stepper("xpbd"), scene, run),
                     other = trajectory_of(stepper("implicit-euler"), scene, run);
    // Implicit Euler may leave 1e-10 of the forces, from 10 N to m v / h = 2000 N, on 1 kg in each step.
    EXPECT_LT(sup_rms(one, other), 1e-10 * (10 + 2 / h) * h) << h;
  }
}

}  // namespace

// Solutions with Lagrange multipliers. Dependent constraints are refused.

namespace {

using namespace testing_tools;

Trajectory by_multipliers(const Scene& scene, const Run& run) {
  MultiplierWorld world(scene, time_grid(run).h);
  Recorder recorder;
  run_loop(world, run, recorder);
  return recorder.trajectory;
}

Scene without_drag(Scene scene) {
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  return scene;
}

TEST(Multipliers, KeepDistancesToTheFourthOrder) {
  const Scene scene = shipped_scene("rod");
  auto drift = [&](double h) {
    double worst = 0;
    for (const Points& x : by_multipliers(scene, {h, 1, 20}).x)
      worst = std::max(worst, largest_constraint_error(*scene.model.find<Constraints>(), x));
    return worst;
  };
  const double coarse = drift(4e-3), fine = drift(2e-3);
  EXPECT_GT(fine, 1e-13);
  EXPECT_NEAR(slope(coarse, fine), 4, 0.5);  // the drift sums errors of both signs
}

TEST(Multipliers, OneRodIsTheRigidPendulum) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.8660254037844386, -0.5, 0]\nmass = 1\n"
      "[[constraint]]\nends = [0, 1]\n[pins]\nparticles = [0]\n" +
      std::string(gravity_text));
  const double period = rigid_pendulum_period(1, 9.81, std::numbers::pi / 3);
  const Trajectory t = by_multipliers(scene, {1e-3, period, 1});
  // The rope returns to rest at its start. The phase error of rk4 is about 1e-12, and its square enters the position.
  EXPECT_LT((t.x.back() - scene.start.x).norm(), 1e-9);
  EXPECT_LT(t.v.back().norm(), 1e-9);
}

TEST(Multipliers, KeepEnergyAndXpbdConvergesToThem) {
  const Scene scene = without_drag(shipped_scene("rod"));
  const Trajectory t = by_multipliers(scene, {2.5e-4, 1, 20});
  for (int i = 0; i < t.frames(); ++i)
    EXPECT_NEAR(energy_of(scene.model, {t.t[i], t.x[i], t.v[i]}).total(), 0, 1e-7);  // J; order h^4 of some 2 J
  double before = 0;
  for (const double h : {4e-4, 2e-4, 1e-4}) {
    const double error = sup_rms(trajectory_of(stepper("xpbd"), shipped_scene("rod"), {h, 1, 20}),
                                 by_multipliers(shipped_scene("rod"), {2.5e-4, 1, 20}));
    if (before > 0) {
      EXPECT_NEAR(slope(before, error), 1, 0.1);  // the next term is smaller by h omega of the whip, some per cent
    }
    before = error;
  }
}

TEST(Multipliers, DependentDistancesAreRefused) {
  // a straight row between two pins, whose forces are not unique
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
      "[[particle]]\nposition = [2, 0, 0]\nmass = 1\n[[constraint]]\nends = [0, 1]\n[[constraint]]\nends = [1, 2]\n"
      "[pins]\nparticles = [0, 2]\n" +
      std::string(gravity_text));
  try {
    by_multipliers(scene, {1e-3, 0.1, 1});
    ADD_FAILURE();
  } catch (const Unsupported& e) {
    EXPECT_TRUE(contains(e.what(), "depend on each other"));
  }
  EXPECT_FALSE(truth_of(scene, {1e-3, 0.1, 1}));
}

TEST(Multipliers, AreTheTruthOfScenesWithHardDistances) {
  for (const auto name : {"rod", "cloth-inextensible"}) {
    const Scene scene = shipped_scene(name);
    const auto truth = truth_of(scene, {scene.step, 0.2, 4});
    ASSERT_TRUE(truth) << name;
    EXPECT_EQ(truth->tier, Tier::converged);
    EXPECT_TRUE(contains(truth->how, "Lagrange multipliers"));
    EXPECT_LT(truth->error_bar, 1e-6);
  }
}

}  // namespace
}  // namespace crosscheck
