// Air on triangles: closed forms, no force without relative motion, both sides alike, the drag's direction.
#include "mysim/energy.h"
#include "tests/unit/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// One triangle of 0.5 m^2 in the plane z = 0, with its corners in the order given.
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
    for (int i = 0; i < 3; ++i) EXPECT_EQ(f.col(i), f.col(0));                          // a third on each corner
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
    EXPECT_EQ(f.x(), 0);  // pressure is along the normal
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
    // what is left of w - (w + w + w) / 3 is an ulp of 7 m/s, and the force is quadratic in it
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
    // gusts act on the mean: a steady wind of the same value at this time
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
    EXPECT_LT(power_of(net.model, net.state, scratch).wind, 0);  // a body that moves as one is held back
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

}  // namespace
}  // namespace crosscheck
