// Implicit steps: the potential and its derivatives, the linear solver, and the equations that a step must satisfy.

#include <fmt/format.h>
#include <Eigen/Dense>

#include <numbers>

#include "mysim/eigenvalues.h"
#include "mysim/implicit/newton.h"
#include "mysim/steppers/steppers.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double h = 0.02;  // s
constexpr SpringLaw laws[] = {SpringLaw::hooke, SpringLaw::bullet_link};

Network busy_network_in_air(unsigned seed, SpringLaw law) {
  Network net = busy_network(seed, law);
  net.model.terms.emplace_back(random_air(seed));
  return net;
}

/// Potential of one step of a random network with every ingredient, and a random point.
struct Problem {
  Network net;
  System f;
  IncrementalPotential potential;
  Random random;
  Points u;

  Problem(unsigned seed, SpringLaw law)
      : net(busy_network_in_air(seed, law)), f(net.model), potential(f), random(seed + 3000) {
    potential.begin(net.state, h);
    u = direction(0.02);
    potential.freeze(u);
  }
  /// Random columns with components up to `size`, zero at pins.
  Points direction(double size) {
    Points p(3, net.model.particles.size());
    for (int i = 0; i < p.cols(); ++i) p.col(i) = size * random.vector();
    for (int pin : net.model.particles.pins) p.col(pin).setZero();
    return p;
  }
};

void for_each_problem(unsigned seeds, const std::function<void(Problem&)>& look) {
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      Problem problem(seed, law);
      look(problem);
    }
}

const double difference_step = std::cbrt(eps);  // m; balances truncation and round-off

TEST(IncrementalPotential, GradientIsTheSlopeOfTheValue) {
  for_each_problem(20, [](Problem& p) {
    Points g;
    p.potential.gradient(p.u, g);
    for (int repetition = 0; repetition < 6; ++repetition) {
      const Points d = p.direction(1);
      const double up = p.potential.value(p.u + difference_step * d), noise = p.potential.rounding(),
                   down = p.potential.value(p.u - difference_step * d);
      // The bound is eps^(2/3) times a sixth of the third derivative (five springs of 3 k r / L^2 at each particle, as
      // in force_test.cpp) times the cube of the direction's size, plus the rounding of the values.
      EXPECT_NEAR(dot(g, d), (up - down) / (2 * difference_step),
                  6000 * std::pow(d.norm(), 3) * std::pow(eps, 2.0 / 3) + noise / difference_step);
    }
    for (int pin : p.net.model.particles.pins) EXPECT_EQ(Vec3(g.col(pin)), Vec3::Zero());
  });
}

TEST(IncrementalPotential, MatrixIsTheSlopeOfTheGradient) {
  for_each_problem(20, [](Problem& p) {
    p.potential.linearise(p.u, Curvature::exact);
    for (int repetition = 0; repetition < 6; ++repetition) {
      const Points d = p.direction(1);
      Points product, up, down;
      p.potential.apply(d, product);
      p.potential.gradient(p.u + difference_step * d, up);
      p.potential.gradient(p.u - difference_step * d, down);
      // The bound is eps^(2/3) times the sum of a sixth of the energy's fourth derivative (five springs of 15 k r /
      // L^3, with L of at least 0.3 m) and the gradients of about 1e3 N.
      EXPECT_LT((product - (up - down) / (2 * difference_step)).cwiseAbs().maxCoeff(),
                1e5 * std::pow(d.norm(), 3) * std::pow(eps, 2.0 / 3));
    }
  });
}

/// Matrix of the unpinned unknowns; fills `free` with their indices.
Eigen::MatrixXd assembled(Problem& p, std::vector<int>& free) {
  free.clear();
  for (int i = 0; i < 3 * p.u.cols(); ++i)
    if (!p.net.model.particles.pinned[i / 3]) free.push_back(i);
  Eigen::MatrixXd a(free.size(), free.size());
  Points unit = Points::Zero(3, p.u.cols()), column;
  for (size_t j = 0; j < free.size(); ++j) {
    unit.reshaped()[free[j]] = 1;
    p.potential.apply(unit, column);
    a.col(static_cast<int>(j)) = column.reshaped()(free);
    unit.setZero();
  }
  return a;
}

TEST(ConjugateGradients, SolveTheAssembledMatrixLikeADirectSolver) {
  for_each_problem(20, [](Problem& p) {
    for (const Curvature curvature : {Curvature::clamped, Curvature::exact}) {
      p.potential.linearise(p.u, curvature);
      std::vector<int> free;
      const Eigen::MatrixXd a = assembled(p, free);
      EXPECT_LT((a - a.transpose()).cwiseAbs().maxCoeff(), 16 * eps * a.cwiseAbs().maxCoeff());  // summation order
      const Eigen::VectorXd values = symmetric_eigenvalues(a);
      if (curvature == Curvature::clamped) {
        EXPECT_GT(values[0], 0);
      }
      const Points b = p.direction(1);
      Points x;
      CgMemory memory;
      const CgResult result = conjugate_gradients([&](const Points& q, Points& out) { p.potential.apply(q, out); },
                                                  [&](const Points& r, Points& z) { p.potential.precondition(r, z); },
                                                  b, 1e-13, 200, x, memory);
      if (values[0] <= 0) {
        EXPECT_TRUE(result.negative_curvature || result.converged);
        continue;
      }
      ASSERT_TRUE(result.converged);
      EXPECT_LE(result.iterations, 3 * static_cast<int>(free.size()));
      const Eigen::VectorXd direct = a.ldlt().solve(b.reshaped()(free));
      // The error is at most the condition number times the residual of 1e-13.
      const double condition = values[values.size() - 1] / values[0];
      EXPECT_LT((x.reshaped()(free) - direct).norm(), 2e-13 * condition * direct.norm());
      for (int pin : p.net.model.particles.pins) EXPECT_EQ(Vec3(x.col(pin)), Vec3::Zero());
    }
  });
}

TEST(ImplicitEuler, StepsSatisfyTheEquations) {
  for (const SpringLaw law : laws)
    for (unsigned seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(fmt::format("{} seed {}", name_of(law), seed));
      const Network net = busy_network_in_air(seed, law);
      const Particles& particles = net.model.particles;
      System f(net.model);
      ImplicitStep step(f);
      State s = net.state;
      for (int n = 0; n < 20; ++n) {
        State end = step.solve(s, h);
        EXPECT_NEAR(end.t, s.t + h, 4 * eps);
        // The residual is at most 1e-10 of the largest force, or the rounding of the forces; u / h rounds once more.
        const double promised =
            1e-10 * step.potential().force_scale() + 2 * step.potential().force_rounding() + 1e-12 / h;
        Points a(3, particles.size());
        f.acceleration(end, a);
        for (int i = 0; i < particles.size(); ++i) {
          if (particles.pinned[i]) continue;
          const Vec3 residual = particles.mass[i] * ((end.v.col(i) - s.v.col(i)) / h - a.col(i));
          EXPECT_LT(residual.norm(), promised);
          EXPECT_LT((end.x.col(i) - s.x.col(i) - h * end.v.col(i)).norm(), 8 * eps * 3);  // lengths up to 3 m
        }
        s = end;
        particles.place_pins(s);
      }
    }
}

/// The gravitational potential cancels if heights have both signs, but its rounding errors do not. Nets at rest,
/// wherever their centre of mass is, fall through height 0.
TEST(ImplicitEuler, FallsThroughTheHeightZero) {
  const double small = 0x1p-10;  // s
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Network net = random_network(seed);
    net.state.v.setZero();
    net.model.particles.pinned.assign(net.model.particles.size(), 0), net.model.particles.pins.clear();
    Springs springs = *net.model.find<Springs>();
    for (Spring& spring : springs.list) spring.rest = (net.state.x.col(spring.a) - net.state.x.col(spring.b)).norm();
    net.model.terms = {springs, Gravity{{0, -9.81, 0}}};
    System f(net.model);
    ImplicitStep step(f);
    State s = net.state;
    for (int n = 1; n <= 512; ++n) ASSERT_NO_THROW(s = step.solve(s, small)) << "step " << n;
    // Backward Euler falls by n (n + 1) / 2 g h^2. A residual force of 1e-12 m v / h in each step adds n^2 / 2 times
    // 1e-12 v h, with v up to 5 m/s.
    for (int i = 0; i < s.x.cols(); ++i)
      EXPECT_NEAR(s.x(1, i) - net.state.x(1, i), -9.81 * small * small * 512 * 513 / 2,
                  512 * 512 / 2 * 1e-12 * 5 * small);
  }
}

/// A single particle falls with drag: the potential has few summands, each of which is rounded more than once.
TEST(Implicit, OneParticleFallsInDrag) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Model model;
    model.particles.mass = Eigen::VectorXd::Constant(1, 0.0647);
    model.particles.pinned = {0};
    model.terms = {Gravity{{0, -9.81, 0}}, Drag{Eigen::VectorXd::Constant(1, 17.8 * 0.0647)}};
    State s{0, Vec3(-0.4986, 0.3474, -0.05423) + 0.3 * random.vector(), Vec3(-3.211, -1.63, -3.496)};
    System f(model);
    Workspace memory(s);
    for (int n = 1; n <= 4096; ++n) {
      ASSERT_NO_THROW(implicit_midpoint(f, s, 0x1p-12, memory)) << "step " << n;
      s.t += 0x1p-12;
    }
  }
}

TEST(ImplicitEuler, LinearOptionIsOneStepOfTheClampedFormula) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Network net = busy_network(seed);
    std::erase_if(net.model.terms, [](const Term& t) { return std::holds_alternative<Dashpots>(t); });
    const Particles& particles = net.model.particles;
    const int n = particles.size();

    // Formula: q = x + h v, (M (1 + h gamma) + h^2 K+(q)) dv = h (f(q) + m g - c v), v' = v + dv, x' = x + h v'
    State q = net.state;
    q.x += h * q.v;
    q.t += h;
    particles.place_pins(q);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * n);
    const Vec3 pull = net.model.find<Gravity>()->acceleration + net.model.find<Wind>()->acceleration.at(q.t);
    for (int i = 0; i < n; ++i) {
      const double m = particles.mass[i], c = net.model.find<Drag>()->c[i];
      a.diagonal().segment<3>(3 * i).array() += m + h * c;
      force.segment<3>(3 * i) += m * pull - c * net.state.v.col(i);
    }
    for (const Spring& s : net.model.find<Springs>()->list) {
      const Vec3 d = q.x.col(s.a) - q.x.col(s.b);
      const double length = d.norm();
      const Eigen::Matrix3d along = d * d.transpose() / (length * length);
      const Eigen::Matrix3d block =
          h * h * s.k * (along + std::max(0.0, 1 - s.rest / length) * (Eigen::Matrix3d::Identity() - along));
      a.block<3, 3>(3 * s.a, 3 * s.a) += block, a.block<3, 3>(3 * s.b, 3 * s.b) += block;
      a.block<3, 3>(3 * s.a, 3 * s.b) -= block, a.block<3, 3>(3 * s.b, 3 * s.a) -= block;
      force.segment<3>(3 * s.a) -= s.k * (length - s.rest) / length * d;
      force.segment<3>(3 * s.b) += s.k * (length - s.rest) / length * d;
    }
    for (const auto& stencil : net.model.find<Bending>()->list)
      for (int i = 0; i < stencil.size; ++i)
        for (int j = 0; j < stencil.size; ++j) {
          const int one = 3 * stencil.particle[i], other = 3 * stencil.particle[j];
          const double k = stencil.k * stencil.weight[i] * stencil.weight[j];
          a.block<3, 3>(one, other).diagonal().array() += h * h * k;
          force.segment<3>(one) -= k * q.x.col(stencil.particle[j]);
        }
    for (int pin : particles.pins)
      for (int row = 3 * pin; row < 3 * pin + 3; ++row) {
        a.row(row).setZero(), a.col(row).setZero();
        a(row, row) = 1, force[row] = 0;
      }
    const Eigen::VectorXd dv = a.ldlt().solve(h * force);

    System f(net.model);
    State s = net.state;
    Workspace w(s);
    stepper("implicit-euler").linear(f, s, h, w);
    const Eigen::VectorXd values = symmetric_eigenvalues(a);
    // The solver stops at 1e-12 of the right-hand side; the error is at most the condition number times this residual.
    const double bound = 1e-12 * values[values.size() - 1] / values[0] * dv.norm() + 64 * eps;
    for (int i = 0; i < n; ++i) {
      if (particles.pinned[i]) continue;
      const Vec3 v = net.state.v.col(i) + dv.segment<3>(3 * i);
      EXPECT_LT((s.v.col(i) - v).norm(), bound);
      EXPECT_LT((s.x.col(i) - net.state.x.col(i) - h * v).norm(), h * bound + 16 * eps);
    }
  }
}

TEST(ImplicitEuler, LinearOptionIsOfTheFirstOrderToo) {
  Stepper linear = stepper("implicit-euler");
  linear.step = linear.linear;
  const Scene scene = small_cloth();
  const Trajectory truth = trajectory_of(stepper("rk4"), scene, {2.5e-4, 0.25, 5});
  auto error = [&](double step) { return sup_rms(trajectory_of(linear, scene, {step, 0.25, 5}), truth); };
  EXPECT_NEAR(slope(error(2e-4), error(1e-4)), 1, 0.1);  // the next error term is smaller by a factor of h omega = 0.04
}

TEST(Implicit, LinksAtRestAreSolvedWhereRoundingLeavesThemNoEnergy) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [1, -0.29, 0]\nmass = 1\n[[particle]]\nposition = [-0.3527, 0, 1]\nmass = 1\n"
      "[[spring]]\nends = [0, 1]\nstiffness = 1\n[springs]\nlaw = \"bullet-link\"\n[gravity]\n"
      "acceleration = [0, -9.8, 0]\n",
      0x1p-7, 0x1p-12, 1);
  for (const double step : {0x1p-12, 0x1p-13, 0x1p-14, 0x1p-15}) {
    NullObserver nobody;
    const Outcome out = simulate(stepper("implicit-euler"), ContactRule::coulomb, scene, {step, 0x1p-7, 1}, nobody);
    EXPECT_EQ(out.verdict, Verdict::ok) << step << ": " << out.reason;
  }
}

TEST(Implicit, AStrutOfStiffSpringsBuckles) {
  // twenty springs, compressed by a tenth of their length, with particles up to a millimetre off the straight line
  constexpr int n = 20;
  std::string text;
  for (int i = 0; i <= n; ++i)
    text += fmt::format("[[particle]]\nposition = [{}, {}, 0]\nmass = 0.01\n", i / 20.,
                        i % n ? 1e-3 * std::sin(std::numbers::pi * i / n) : 0);
  for (int i = 0; i < n; ++i)
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = 1e6\nrest = 0.055\n", i, i + 1);
  text += fmt::format("[pins]\nparticles = [0, {}]\n[gravity]\nacceleration = [0, -9.81, 0]\n", n);
  for (const auto name : {"implicit-euler", "implicit-midpoint"}) {
    NullObserver nobody;
    const Scene scene = small_scene(text, 0.1, 0.1, 1);
    const Outcome out = simulate(stepper(name), ContactRule::coulomb, scene, {0.1, 0.1, 1}, nobody);
    EXPECT_EQ(out.verdict, Verdict::ok) << name << ": " << out.reason;
  }
}

}  // namespace
}  // namespace crosscheck
