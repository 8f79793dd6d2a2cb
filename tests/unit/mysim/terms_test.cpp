// Single terms: coincident ends, drag, wind, prescribed motion, and air on triangles.

#include <numbers>
#include <random>

#include "mysim/base/random.h"
#include "mysim/model/energy.h"
#include "mysim/portable_trigonometry.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Terms, EndsThatMeetGetNoForceAndAreCounted) {
  Model model;
  model.particles.mass = Eigen::VectorXd::Ones(2);
  model.particles.pinned.assign(2, 0);
  const State state{0, Points::Ones(3, 2), Points::Zero(3, 2)};
  for (const double rest : {0.0, 0.5}) {
    Forces forces{Points::Zero(3, 2)};
    add_force(Springs{{{0, 1, 100, rest, Family::single}}}, model.particles, state, forces);
    EXPECT_TRUE(forces.f.isZero(0));
    EXPECT_EQ(forces.degenerate_springs, rest > 0 ? 1 : 0);  // with rest length zero nothing is undefined
  }
}

TEST(Terms, ARunCountsEndsThatMet) {
  // Two particles meet in exactly representable steps, and separate again.
  const Scene scene = small_scene(
      "[[particle]]\nposition = [-1, 0, 0]\nmass = 1\nvelocity = [1, 0, 0]\n"
      "[[particle]]\nposition = [1, 0, 0]\nmass = 1\nvelocity = [-1, 0, 0]\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 1e-300\nrest = 1\n",
      2, 0.25, 1);
  Recorder r;
  const Outcome out = simulate(stepper("symplectic-euler"), ContactRule::coulomb, scene, {0.25, 2, 1}, r);
  EXPECT_EQ(out.degenerate_springs, 1);
  EXPECT_TRUE(r.trajectory.x.back().allFinite());
}

TEST(Terms, DragTakesPowerAndIsLinear) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Network net = random_network(seed);
    Random random(seed);
    Eigen::VectorXd c(6);
    for (double& each : c) each = random.between(0.1, 3);
    net.model.terms.emplace_back(Drag{c});
    Forces scratch{Points::Zero(3, 6)};
    double expected = 0;
    for (int i = 0; i < 6; ++i) expected += c[i] * net.state.v.col(i).squaredNorm();
    EXPECT_NEAR(power_of(net.model, net.state, scratch).dissipated(), expected,
                32 * eps * expected);  // 6 x 3 roundings
    State faster = net.state;
    faster.v *= 2;
    EXPECT_TRUE((force_of<Drag>(net.model, faster) - 2 * force_of<Drag>(net.model, net.state)).isZero(0));
  }
}

/// Error in units in the last place (ulp).
double error_of(double value, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  return static_cast<double>(std::abs(value - exact)) / (std::nextafter(nearest, INFINITY) - nearest);
}

TEST(PortableTrigonometry, IsRightToAUnitInTheLastPlaceUpToAMillionRadians) {
  // Rounding of the result is half an ulp. The reduced angle and the series add less than 0.6.
  const double allowed = 1.1;
  std::mt19937_64 engine(1);
  for (const double most : {1e-300, 1e-8, 0.8, 3.2, 10., 1e3, 1e6})
    for (int i = 0; i < 20000; ++i) {
      const double x = most * (2 * uniform(engine) - 1);
      EXPECT_LE(error_of(portable_sin(x), std::sin(static_cast<long double>(x))), allowed) << x;
      EXPECT_LE(error_of(portable_cos(x), std::cos(static_cast<long double>(x))), allowed) << x;
    }
  // next to multiples of pi/2, where the argument reduction cancels most
  for (int n = 1; n < 1000000; n = 3 * n + 1) {
    const double x = n * std::numbers::pi / 2;
    EXPECT_LE(error_of(portable_sin(x), std::sin(static_cast<long double>(x))), allowed) << n;
    EXPECT_LE(error_of(portable_cos(x), std::cos(static_cast<long double>(x))), allowed) << n;
  }
}

TEST(PortableTrigonometry, IsOddEvenAndNotANumberOfWhatIsNotFinite) {
  for (const double x : {0., 0.3, 1.7, 40., 12345.678}) {
    EXPECT_EQ(portable_sin(-x), -portable_sin(x));
    EXPECT_EQ(portable_cos(-x), portable_cos(x));
  }
  EXPECT_EQ(portable_cos(0), 1);
  for (const double x : {INFINITY, -INFINITY, NAN})
    EXPECT_TRUE(std::isnan(portable_sin(x)) && std::isnan(portable_cos(x)));
}

/// Any build must reproduce these bits, whatever its C library.
TEST(PortableTrigonometry, HasTheseBits) {
  EXPECT_EQ(portable_sin(1), 0x1.aed548f090ceep-1);
  EXPECT_EQ(portable_cos(1), 0x1.14a280fb5068cp-1);
  EXPECT_EQ(portable_sin(1234.5), 0x1.29c531dfd031bp-3);
  EXPECT_EQ(portable_cos(1234.5), -0x1.fa8f2ceb78372p-1);
}

TEST(Vectors, AreSummedFromTheFirstToTheLast) {
  // each summation order gives a different last digit
  const Vec3 v(1, 0x1p-53, 0x1p-53);
  EXPECT_EQ(v.sum(), (1 + 0x1p-53) + 0x1p-53);
  EXPECT_NE(v.sum(), 1 + (0x1p-53 + 0x1p-53));
  Points p(3, 2);
  p.col(0) = p.col(1) = v;
  EXPECT_EQ(p.col(1).sum(), v.sum());
  EXPECT_EQ(v.dot(Vec3::Ones()), v.sum());
  EXPECT_EQ((v.array() * Vec3(1, 1, 1).array()).sum(), v.sum());
}

TEST(Wind, IsSeededBoundedAndSmooth) {
  const WindSignal wind = gusty(7), same = gusty(7), other = gusty(8);
  const double bound = 0.8 * wind.mean.norm() + 2;    // variation times mean, plus side; gusts lie in [-1, 1]
  const double fastest = 2 * std::numbers::pi * 1.2;  // rad/s, fastest wave
  double difference = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i, dt = 1e-4;
    const Vec3 a = wind.at(t);
    EXPECT_EQ(a, same.at(t));
    difference = std::max(difference, (a - other.at(t)).norm());
    EXPECT_LE((a - wind.mean).norm(), bound * (1 + 4 * eps));
    EXPECT_LE((wind.at(t + dt) - a).norm(), bound * fastest * dt);
  }
  EXPECT_GT(difference, 0.1 * bound);  // different seeds give different gusts
}

TEST(Wind, GustsAlongAndAcrossDifferAndReachAFairShareOfTheirRange) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Gust along(seed, 1), across(seed, 2);
    double low = 0, high = 0, apart = 0;
    for (int i = 0; i < 2000; ++i) {
      low = std::min(low, along.at(0.05 * i));
      high = std::max(high, along.at(0.05 * i));
      apart = std::max(apart, std::abs(along.at(0.05 * i) - across.at(0.05 * i)));
    }
    // four incommensurable waves come close to -1 and 1 within a hundred seconds
    EXPECT_LT(low, -0.5);
    EXPECT_GT(high, 0.5);
    EXPECT_LE(std::max(-low, high), 1 + 4 * eps);  // weights add up to 1 up to rounding
    EXPECT_GT(apart, 0.5);
  }
}

TEST(Wind, SteadyWindIsTheSameAlwaysAndPushesByMass) {
  const Wind wind{{{1, 2, 3}, std::nullopt}};
  EXPECT_EQ(wind.acceleration.at(0), wind.acceleration.at(12.3));
  Network net = random_network(1);
  net.model.terms.emplace_back(wind);
  const Points f = force_of<Wind>(net.model, net.state);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(Vec3(f.col(i)), net.model.particles.mass[i] * wind.acceleration.mean);
}

TEST(PrescribedMotion, VelocityIsTheDerivativeOfDisplacement) {
  const Motion motion{{0.1, -0.2, 0.3}, 0.7, 0.5};
  const double step = std::cbrt(eps);
  for (double t = 0.01; t < 2; t += 0.0137) {
    const Vec3 numeric = (displacement_at(motion, t + step) - displacement_at(motion, t - step)) / (2 * step);
    // The error is eps^(2/3) times a sixth of the third derivative, which the ramp makes as large as 60 A / ramp^3 plus
    // omega^3 A.
    EXPECT_LT((numeric - velocity_at(motion, t)).norm(), 200 * std::pow(eps, 2.0 / 3));
  }
}

TEST(PrescribedMotion, StartsAtRestAndIsTwiceContinuousAtBothEndsOfTheRamp) {
  const Motion motion{{0, 0, 0.15}, 0.5, 0.5};
  EXPECT_EQ(displacement_at(motion, 0), Vec3::Zero());
  EXPECT_EQ(velocity_at(motion, 0), Vec3::Zero());
  auto acceleration = [&](double t) -> Vec3 {
    const double dt = 1e-6;
    return (velocity_at(motion, t + dt) - velocity_at(motion, t)) / dt;
  };
  for (const double joint : {0.0, 0.5}) {
    const double before = joint == 0 ? 0 : acceleration(joint - 2e-6).z(), after = acceleration(joint + 1e-6).z();
    // The jerk next to a joint is at most 60 A / ramp^3 = 72 m/s^3, which changes the acceleration by 2.2e-4 in 3e-6 s.
    EXPECT_NEAR(before, after, 2.2e-4);
    EXPECT_LT((displacement_at(motion, joint + 1e-9) - displacement_at(motion, std::max(0.0, joint - 1e-9))).norm(),
              2e-9);  // speeds stay below 1 m/s
  }
}

TEST(PrescribedMotion, PinsFollowItInEveryStepper) {
  const Scene scene = small_cloth();
  const auto& particles = scene.model.particles;
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 0.5, 10});
    for (int i = 0; i < t.frames(); ++i)
      for (int pin : particles.pins) {
        EXPECT_EQ(Vec3(t.x[i].col(pin)), Vec3(scene.start.x.col(pin) + displacement_at(*particles.move, t.t[i])));
        EXPECT_EQ(Vec3(t.v[i].col(pin)), velocity_at(*particles.move, t.t[i]));
      }
  }
}

using namespace testing_tools;

/// A triangle of 0.5 m^2 in the plane z = 0, with its corners in the given order.
Network flat(std::array<int, 3> corners = {0, 1, 2}) {
  Network net;
  net.model.particles.mass = Eigen::VectorXd::Ones(3);
  net.model.particles.pinned.assign(3, 0);
  net.state.x = net.state.v = Points::Zero(3, 3);
  net.state.x.col(1) = Vec3(1, 0, 0);
  net.state.x.col(2) = Vec3(0, 1, 0);
  net.model.terms.emplace_back(Aerodynamics{1.2, 1.5, {Vec3::Zero(), std::nullopt}, {corners}});
  return net;
}
Points force_in(Network net, const Vec3& wind) {
  net.model.find<Aerodynamics>()->velocity.mean = wind;
  return force_of(*net.model.find<Aerodynamics>(), net);
}
Vec3 total(const Points& f) { return f.rowwise().sum(); }

constexpr double area = 0.5, density = 1.2, coefficient = 1.5;

TEST(Aerodynamics, FaceOnItIsHalfRhoCAreaSpeedSquared) {
  for (const double w : {0.1, 3.0, -20.0}) {
    const Points f = force_in(flat(), {0, 0, w});
    const double expected = density * coefficient * area * w * std::abs(w) / 2;
    EXPECT_LT((total(f) - Vec3(0, 0, expected)).norm(), 8 * eps * std::abs(expected));  // a few roundings
    for (int i = 0; i < 3; ++i) EXPECT_EQ(f.col(i), f.col(0));                          // a third for each corner
  }
}

TEST(Aerodynamics, EdgeOnThereIsNone) {
  for (const Vec3& wind : {Vec3(3, 0, 0), Vec3(1, -7, 0)}) EXPECT_TRUE(force_in(flat(), wind).isZero(0));
}

TEST(Aerodynamics, AtAnAngleItFollowsTheSine) {
  const double w = 4;
  for (double angle = 0.05; angle < 1.6; angle += 0.1) {  // rad, between air and plate
    const Vec3 f = total(force_in(flat(), {w * std::cos(angle), 0, w * std::sin(angle)}));
    const double expected = density * coefficient * area * w * w / 2 * std::sin(angle);
    EXPECT_NEAR(f.z(), expected, 16 * eps * expected + 4 * eps);
    EXPECT_EQ(f.x(), 0);  // pressure acts along the normal
    EXPECT_EQ(f.y(), 0);
  }
}

TEST(Aerodynamics, WithoutRelativeMotionThereIsNone) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Network net = random_network(seed);
    net.model.terms.emplace_back(random_air(seed));
    net.state.t = 0.3;
    const Vec3 wind = net.model.find<Aerodynamics>()->velocity.at(0.3);
    for (int i = 0; i < 6; ++i) net.state.v.col(i) = wind;
    // w - (w + w + w) / 3 leaves an ulp of 7 m/s, and the force is quadratic in this difference.
    EXPECT_LT(force_of(*net.model.find<Aerodynamics>(), net).cwiseAbs().maxCoeff(), 10 * std::pow(8 * eps, 2) * 50);
  }
}

TEST(Aerodynamics, OnlyTheRelativeVelocityCounts) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Network net = random_network(seed);
    net.model.terms.emplace_back(random_air(seed));
    const Points f = force_of(*net.model.find<Aerodynamics>(), net);
    Random random(seed);
    const Vec3 boost = random.vector();
    net.state.v.colwise() += boost;
    Aerodynamics& air = *net.model.find<Aerodynamics>();
    // Gusts scale the mean, so they would also scale the boost: replace them by a steady wind of the same value.
    air.velocity = {air.velocity.at(net.state.t) + boost, std::nullopt};
    EXPECT_LT((force_of(air, net) - f).cwiseAbs().maxCoeff(), 64 * eps * f.cwiseAbs().maxCoeff() + 64 * eps);
  }
}

TEST(Aerodynamics, BothSidesOfATriangleAreAlike) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Vec3 wind = 5 * random.vector();
    const Points f = force_in(flat({0, 1, 2}), wind), flipped = force_in(flat({0, 2, 1}), wind);
    EXPECT_LT((f - flipped).cwiseAbs().maxCoeff(), 4 * eps * f.cwiseAbs().maxCoeff());
  }
}

TEST(Aerodynamics, InStillAirItOnlyTakesEnergyAndInWindItPushesAlong) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Network net = random_network(seed);
    net.model.terms.emplace_back(random_air(seed));
    Aerodynamics& air = *net.model.find<Aerodynamics>();
    air.velocity = {Vec3::Zero(), std::nullopt};
    for (int i = 0; i < 6; ++i) net.state.v.col(i) = Vec3(0.3, -1, 0.7);
    Forces scratch{Points::Zero(3, 6)};
    EXPECT_LT(power_of(net.model, net.state, scratch).wind, 0);  // a rigidly moving body is slowed down
    net.state.v.setZero();
    air.velocity.mean = Vec3(2, 1, -3);
    EXPECT_GT(total(force_of(air, net)).dot(air.velocity.mean), 0);
  }
}

TEST(Aerodynamics, ATriangleWithoutAreaHasNoForce) {
  Network net = flat();
  net.state.x.col(2) = Vec3(2, 0, 0);
  EXPECT_TRUE(force_in(net, {1, 2, 3}).isZero(0));
}

TEST(Terms, EnergyOfALinkIsNeverBelowZero) {
  // Near the rest length both parts of the energy cancel. A straightforward formula was negative for one in a hundred
  // lengths within a few roundings of the rest length, and an implicit step takes the square root of the sum.
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double rest = random.between(0.1, 3);
    State state{0, Points::Zero(3, 2), Points::Zero(3, 2)};
    state.x(0, 1) = rest * (1 + (i % 7 - 3) * eps / 2);
    EXPECT_GE(potential_energy(Springs{{{0, 1, 1, rest, Family::single}}, SpringLaw::bullet_link}, {}, state), 0) << i;
  }
}

}  // namespace
}  // namespace crosscheck
