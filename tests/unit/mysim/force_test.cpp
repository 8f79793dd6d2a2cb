// Forces of all terms: negative gradients of their energies, their tangents, conservation laws, rotation invariance.

#include <Eigen/Dense>

#include "mysim/eigenvalues.h"
#include "mysim/forces.h"
#include "mysim/model/energy.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr SpringLaw laws[] = {SpringLaw::hooke, SpringLaw::bullet_link};

/// Calls look(type) with a null pointer of each type in the table of terms.
template <class Look, size_t... I>
void for_each_term_type(Look look, std::index_sequence<I...>) {
  (look(static_cast<std::variant_alternative_t<I, Term>*>(nullptr)), ...);
}
template <class Look>
void for_each_term_type(Look look) {
  for_each_term_type(look, std::make_index_sequence<std::variant_size_v<Term>>());
}

/// A network with every term that exerts a force.
Network full_network(unsigned seed, SpringLaw law) {
  Network net = busy_network(seed, law);
  net.model.terms.emplace_back(random_air(seed));
  return net;
}

const double step = std::cbrt(eps);  // balances truncation and round-off of a central difference

TEST(Forces, AreMinusTheGradientOfEveryEnergyThereIs) {
  int energies = 0;
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      const Network net = full_network(seed, law);
      for_each_term_type([&]<class T>(T*) {
        if constexpr (HasPotential<T>) {
          const T* term = net.model.find<T>();
          ASSERT_TRUE(term) << "add the new term with an energy to the network: " << T::name;
          const Points f = force_of(*term, net);
          auto energy = [&](int axis, int i, double by) {
            State moved = net.state;
            moved.x(axis, i) += by;
            return potential_energy(*term, net.model.particles, moved);
          };
          for (int i = 0; i < f.cols(); ++i)
            for (int axis = 0; axis < 3; ++axis) {
              // The energies of springs and bending include pins; those of other terms do not.
              if (net.model.particles.pinned[i] && !HasTangent<T>) continue;
              const double slope_there = (energy(axis, i, step) - energy(axis, i, -step)) / (2 * step);
              // The error is eps^(2/3) times E''' / 6 (up to 5 springs of 3 k r / L^2 = 7000 N/m^2 each; the link law
              // is no steeper), plus eps^(2/3) times E.
              EXPECT_NEAR(f(axis, i), -slope_there, 6000 * std::pow(eps, 2.0 / 3)) << T::name;
            }
          ++energies;
        }
      });
    }
  EXPECT_EQ(energies, 3 * 2 * 20);  // springs, bending, gravity
}

/// Product of one term's tangent with d.
template <class T>
Points product(const Network& net, Curvature curvature, double stiffness, double damping, const Points& d) {
  Tangent tangent;
  add_tangent(*net.model.find<T>(), net.model.particles, net.state, curvature, tangent);
  Points out = Points::Zero(3, d.cols());
  tangent.add_product(stiffness, damping, d, out);
  return out;
}

Points random_columns(Random& random, long n) {
  Points d(3, n);
  for (int i = 0; i < n; ++i) d.col(i) = random.vector();
  return d;
}

TEST(Tangents, OfSpringsIsTheSlopeOfTheForce) {
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      const Network net = random_network(seed, law);
      Random random(seed + 50);
      const Points d = random_columns(random, net.state.x.cols());
      Network up = net, down = net;
      up.state.x += step * d;
      down.state.x -= step * d;
      const Springs& springs = *net.model.find<Springs>();
      const Points slope_there = (force_of(springs, up) - force_of(springs, down)) / (2 * step);
      // The error is eps^(2/3) times a sixth of the force's third derivative, which is 15 k r / L^3 times |d|^3 for
      // each of five springs, with L of at least 0.3 m.
      EXPECT_LT((product<Springs>(net, Curvature::exact, 1, 0, d) + slope_there).cwiseAbs().maxCoeff(),
                1e6 * std::pow(eps, 2.0 / 3));
    }
}

TEST(Tangents, OfDashpotsIsExactAlongFixedDirections) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Network net = busy_network(seed);
    Random random(seed + 50);
    const Points d = random_columns(random, net.state.x.cols());
    Network faster = net;
    faster.state.v += d;
    const Dashpots& dashpots = *net.model.find<Dashpots>();
    const Points change = force_of(dashpots, faster) - force_of(dashpots, net);
    // The force is linear in the velocities, so the error is some roundings of five forces of up to 2 N s/m times 4
    // m/s.
    EXPECT_LT((product<Dashpots>(net, Curvature::exact, 0, 1, d) + change).cwiseAbs().maxCoeff(), 5 * 8 * 16 * eps);
  }
}

/// The 3n x 3n stiffness matrix K of the springs.
Eigen::MatrixXd matrix_of(const Network& net, Curvature curvature) {
  const int n = static_cast<int>(net.state.x.cols());
  Eigen::MatrixXd k(3 * n, 3 * n);
  Points unit = Points::Zero(3, n);
  for (int i = 0; i < 3 * n; ++i) {
    unit.reshaped()[i] = 1;
    k.col(i) = product<Springs>(net, curvature, 1, 0, unit).reshaped();
    unit.setZero();
  }
  return k;
}

TEST(Tangents, ClampedIsPositiveSemidefiniteAndExactWhereAllSpringsAreStretched) {
  int indefinite = 0;
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      Network net = random_network(seed, law);
      const Eigen::MatrixXd clamped = matrix_of(net, Curvature::clamped), exact = matrix_of(net, Curvature::exact);
      const double size = clamped.norm();
      auto lowest = [](const Eigen::MatrixXd& k) { return symmetric_eigenvalues(k)[0]; };
      EXPECT_GE(lowest(clamped), -32 * eps * size);  // round-off of the eigenvalue solver with 18 unknowns
      EXPECT_LT((exact - exact.transpose()).cwiseAbs().maxCoeff(), 4 * eps * size);
      indefinite += lowest(exact) < -1e-6 * size;
      for (Spring& s : net.model.find<Springs>()->list) s.rest *= 0.1;  // distances >= 0.3 m, rest lengths now <= 0.2 m
      EXPECT_EQ(matrix_of(net, Curvature::clamped), matrix_of(net, Curvature::exact));
    }
  EXPECT_GT(indefinite, 20);  // otherwise the clamp would not be tested
}

/// Sum of forces and of torques about the origin.
std::pair<Vec3, Vec3> resultant(const Points& f, const Points& x) {
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (int i = 0; i < f.cols(); ++i) {
    sum += f.col(i);
    torque += Vec3(x.col(i)).cross(Vec3(f.col(i)));
  }
  return {sum, torque};
}

TEST(Forces, InsideABodyKeepMomentumAndAngularMomentum) {
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      const Network net = busy_network(seed, law);
      for (const Points& f : {force_of(*net.model.find<Springs>(), net), force_of(*net.model.find<Bending>(), net),
                              force_of(*net.model.find<Dashpots>(), net)}) {
        const auto [sum, torque] = resultant(f, net.state.x);
        // bound: about thirty additions of forces of up to 900 N (in the link law at most k L), at up to 2 m from the
        // origin
        EXPECT_LT(sum.norm(), 30 * eps * 900);
        EXPECT_LT(torque.norm(), 60 * eps * 900 * 2);
      }
    }
}

TEST(Forces, TurnAndMoveWithTheBody) {
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      Random random(100 + seed);
      const Network net = full_network(seed, law);
      const Eigen::Matrix3d turn = random_turn(random);
      const Vec3 shift = random.vector();
      Network moved = net;
      moved.state.x = (turn * net.state.x).colwise() + shift;
      moved.state.v = turn * net.state.v;
      for (Term& term : moved.model.terms) {
        auto turn_blowing = [&](WindSignal& b) { b.mean = turn * b.mean, b.gusts->side = turn * b.gusts->side; };
        if (auto* gravity = std::get_if<Gravity>(&term)) gravity->acceleration = turn * gravity->acceleration;
        if (auto* wind = std::get_if<Wind>(&term)) turn_blowing(wind->acceleration);
        if (auto* air = std::get_if<Aerodynamics>(&term)) turn_blowing(air->velocity);
      }
      for_each_term_type([&]<class T>(T*) {
        if constexpr (HasForce<T>) {
          const T *here = net.model.find<T>(), *there = moved.model.find<T>();
          ASSERT_TRUE(here && there) << "add the new force to the network: " << T::name;
          const Points expected = turn * force_of(*here, net);
          // Round-off: a few ulps of lengths up to 3 m, times a stiffness of up to 100 N/m, in five springs. Other
          // forces are weaker.
          EXPECT_LT((force_of(*there, moved) - expected).cwiseAbs().maxCoeff(), 5 * 100 * 3 * 16 * eps) << T::name;
        }
      });
    }
}

TEST(Dashpots, TakeThePowerOfWhatStretches) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Network net = random_network(seed);
    net.model.terms.emplace_back(random_dashpots(seed, net));
    double expected = 0;
    for (const auto& [a, b, c] : net.model.find<Dashpots>()->list) {
      const Vec3 n = (net.state.x.col(a) - net.state.x.col(b)).normalized();
      expected += c * std::pow((net.state.v.col(a) - net.state.v.col(b)).dot(n), 2);
    }
    Forces scratch{Points::Zero(3, 6)};
    const Power power = power_of(net.model, net.state, scratch);
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(power.dashpots, expected, 1e3 * eps * expected);  // 15 pairs, sums of forces that partly cancel
    EXPECT_EQ(power.pins, 0);
  }
}

TEST(Dashpots, LeaveRigidMotionAlone) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Network net = random_network(seed);
    Random random(seed + 7);
    const Vec3 velocity = random.vector(), spin = 5 * random.vector();
    for (int i = 0; i < 6; ++i) net.state.v.col(i) = velocity + spin.cross(Vec3(net.state.x.col(i)));
    // (v_a - v_b) . d cancels to some ulps of 9 rad/s times (3.5 m)^2. The force divides this by |d|, which is at least
    // 0.3 m.
    EXPECT_LT(force_of(random_dashpots(seed, net), net).cwiseAbs().maxCoeff(), 5 * 2 * 8 * eps * 9 * 12 / 0.3);
  }
}

TEST(LinkLaw, HasTheTensionAndTheEnergyOfItsFormulas) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Spring s{0, 1, random.between(1, 100), random.between(0.1, 2), Family::single};
    const double length = random.between(0.05, 3), l2 = length * length, r2 = s.rest * s.rest;
    const auto [force, slope_there] = tension_of(s, SpringLaw::bullet_link, length);
    EXPECT_NEAR(force, s.k * length * (l2 - r2) / (l2 + r2), 8 * eps * s.k * length);
    auto tension = [&](double at) { return tension_of(s, SpringLaw::bullet_link, at).force; };
    // bound: eps^(2/3) (|T'''| / 6 + |T|), where T is the tension, |T'''| < 24 k / r^2 and |T| <= 3 k
    EXPECT_NEAR(slope_there, (tension(length + step) - tension(length - step)) / (2 * step),
                (4 * s.k / r2 + s.k * 3) * std::pow(eps, 2.0 / 3));
    // the energy is the integral of the tension from the rest length, computed by Simpson's rule with 2000 intervals
    const int n = 2000;
    double integral = 0;
    for (int j = 0; j <= n; ++j)
      integral += (j == 0 || j == n ? 1 : j % 2 ? 4 : 2) * tension(s.rest + (length - s.rest) * j / n);
    integral *= (length - s.rest) / (3 * n);
    Model model;
    Points x = Points::Zero(3, 2);
    x(0, 0) = length;
    const double energy = potential_energy(Springs{{s}, SpringLaw::bullet_link}, model.particles, {0, x, x});
    // Simpson's error: (3 m)^5 / (180 * 2000^4) times a fourth derivative below 500 k / r^3 = 5e7 k
    EXPECT_NEAR(energy, integral, 1e-10 * s.k * (1 + 1 / (r2 * s.rest)) + 1e-13 * s.k * 10);
  }
}

TEST(LinkLaw, IsHookesToFirstOrderInTheStretch) {
  const Spring s{0, 1, 50, 0.8, Family::single};
  auto difference = [&](double stretch) {
    return std::abs(tension_of(s, SpringLaw::bullet_link, s.rest + stretch).force - s.k * stretch);
  };
  for (const double stretch : {1e-2, 1e-3}) {
    // the next term of the tension is k e^2 / (2 r), which is of second order on both sides
    EXPECT_NEAR(difference(stretch), s.k * stretch * stretch / (2 * s.rest), 2 * s.k * stretch * stretch * stretch);
    EXPECT_NEAR(slope(difference(stretch), difference(stretch / 2)), 2, 0.05);
  }
  EXPECT_EQ(tension_of(s, SpringLaw::bullet_link, s.rest).force, 0);
  EXPECT_NEAR(tension_of(s, SpringLaw::bullet_link, s.rest).slope, s.k, 4 * eps * s.k);
}

}  // namespace
}  // namespace crosscheck
