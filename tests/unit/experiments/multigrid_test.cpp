// Linear systems of implicit steps on cloths are solved to the tolerance for any size, pins and instruction set, and
// the number of iterations hardly depends on the size.

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include "experiments/scenes/cloths.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/implicit/newton.h"
#include "mysim/scene/grid.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// A crumpled cloth with arbitrary pins: the data of a linear system, and the system's matrix in sparse form.
struct Problem {
  simd::GridTopology topology;
  std::vector<int> pins;
  Model model;
  Eigen::ArrayXd inertia;  // N/m
  Points x, b;             // m, N

  Problem(unsigned seed, int rows, int columns, double crumpled = 0.2, double stiff = 400)
      : topology{rows, columns, {}} {
    Random random(seed);
    const int n = rows * columns;
    Springs springs;
    for (int d = 0; d < simd::directions; ++d) {
      if (random.between(0, 1) < 0.15 && d > 0) continue;  // a missing spring family
      const auto [down, right] = simd::direction[d];
      topology.families[d] = {stiff * random.between(0.1, 1), std::hypot(down, right) * random.between(0.9, 1.1)};
      for (int i = 0; i < n; ++i)
        if (const int row = i / columns + down, column = i % columns + right;
            row < rows && column >= 0 && column < columns)
          springs.list.push_back(
              {i, row * columns + column, topology.families[d]->k, topology.families[d]->rest, Family::single});
    }
    model.terms.emplace_back(springs);
    Particles& p = model.particles;
    p.mass = Eigen::VectorXd::Ones(n), p.pinned.assign(n, 0);
    x.resize(3, n), b.resize(3, n), inertia.resize(n);
    for (int i = 0; i < n; ++i) {
      x.col(i) = Vec3(i % columns, 0, i / columns) + crumpled * random.vector();
      b.col(i) = random.vector();
      inertia[i] = random.between(1, 3);
    }
    for (const int pin : {0, columns - 1, static_cast<int>(random.between(0, n)), n - 2})
      if (!p.pinned[pin]) p.pinned[pin] = 1, pins.push_back(pin), b.col(pin).setZero();
    p.pins = pins;
  }

  /// The matrix inertia + K, with 1 on the diagonal for pins.
  Eigen::SparseMatrix<double> matrix(Curvature curvature) const {
    Tangent tangent;
    add_tangent(*model.find<Springs>(), model.particles, {0, x, {}}, curvature, tangent);
    std::vector<Eigen::Triplet<double>> parts;
    const auto add = [&](int row, int column, const Eigen::Matrix3d& block) {
      if (model.particles.pinned[row] || model.particles.pinned[column]) return;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) parts.emplace_back(3 * row + i, 3 * column + j, block(i, j));
    };
    for (int i = 0; i < x.cols(); ++i)
      for (int c = 0; c < 3; ++c) parts.emplace_back(3 * i + c, 3 * i + c, model.particles.pinned[i] ? 1 : inertia[i]);
    for (const Tangent::Pair& p : tangent.stiffness()) {
      const Eigen::Matrix3d block =
          p.across * Eigen::Matrix3d::Identity() + (p.along - p.across) * p.n * p.n.transpose();
      add(p.a, p.a, block), add(p.b, p.b, block), add(p.a, p.b, -block), add(p.b, p.a, -block);
    }
    Eigen::SparseMatrix<double> m(3 * x.cols(), 3 * x.cols());
    m.setFromTriplets(parts.begin(), parts.end());
    return m;
  }
  Points by_factorisation(Curvature curvature) const {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix(curvature));
    return solver.solve(b.reshaped()).reshaped(3, x.cols());
  }
};

CgResult solve(const Problem& p, simd::InstructionSet isa, Curvature curvature, double tolerance, Points& u) {
  const ScopedInstructionSet kept(isa);
  return multigrid::MultigridSolver(p.topology, p.pins).solve(p.inertia, p.x, curvature, p.b, tolerance, u);
}

// sizes around 16 lanes and around half of that, odd and even numbers of rows, and one cloth with several levels
constexpr std::pair<int, int> sizes[] = {{12, 20}, {13, 31}, {20, 32}, {33, 33},
                                         {15, 48}, {40, 64}, {31, 65}, {3, 100}};

TEST(Multigrid, SolvesWhatAFactorisationSolves) {
  unsigned seed = 0;
  for (const auto& [rows, columns] : sizes)
    for (const simd::InstructionSet isa : simd::supported_instruction_sets()) {
      SCOPED_TRACE(fmt::format("{} x {}, {}", rows, columns, name_of(isa)));
      const Problem p(++seed, rows, columns);
      const Points wanted = p.by_factorisation(Curvature::clamped);
      Points u;
      EXPECT_TRUE(solve(p, isa, Curvature::clamped, 1e-12, u).converged);
      // |u - A^-1 b| <= |A^-1| |b - A u|, and the eigenvalues of A are at least the smallest inertia, 1 N/m. A factor
      // of ten allows for the recurrence of the residual.
      EXPECT_LE((u - wanted).norm(), 1e-11 * p.b.norm());
      for (const int pin : p.pins) EXPECT_EQ(u.col(pin), Vec3::Zero());
    }
}

TEST(Multigrid, TakesCurvatureAsItIs) {
  // Rest lengths exceed the distances of the ends by up to 10 %, so that some springs are compressed; inertia keeps the
  // matrix definite.
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Problem p(seed, 20, 40, 0.05, 20);
    p.inertia += 100;
    const Points exact = p.by_factorisation(Curvature::exact), clamped = p.by_factorisation(Curvature::clamped);
    Points u;
    ASSERT_TRUE(solve(p, simd::active_instruction_set(), Curvature::exact, 1e-12, u).converged);
    EXPECT_LE((u - exact).norm(), 1e-13 * p.b.norm());  // inertia is at least 100 N/m
    EXPECT_GT((exact - clamped).norm(), 1e-6 * p.b.norm());
  }
}

TEST(Multigrid, StopsAtNegativeCurvature) {
  Problem p(7, 20, 40, 0.01, 400);
  p.x *= 0.5;  // all springs have half of their rest length, and no lateral support
  Points u;
  const CgResult result = solve(p, simd::active_instruction_set(), Curvature::exact, 1e-12, u);
  EXPECT_TRUE(result.negative_curvature);
  EXPECT_FALSE(result.converged);
  EXPECT_TRUE(solve(p, simd::active_instruction_set(), Curvature::clamped, 1e-12, u).converged);
}

TEST(Multigrid, EndsThatMeetHaveNoStiffness) {
  Problem p(3, 16, 40);
  p.x.col(100) = p.x.col(101);
  Points u;
  ASSERT_TRUE(solve(p, simd::active_instruction_set(), Curvature::clamped, 1e-12, u).converged);
  EXPECT_LE((u - p.by_factorisation(Curvature::clamped)).norm(), 1e-11 * p.b.norm());
}

TEST(Multigrid, NothingAskedIsNothingMoved) {
  Problem p(3, 16, 40);
  p.b.setZero();
  Points u;
  const CgResult result = solve(p, simd::active_instruction_set(), Curvature::clamped, 1e-12, u);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(u, Points::Zero(3, 640));
}

/// z = M^-1 r by one V-cycle.
Points cycle(multigrid::VCycle& matrix, const Points& r) {
  multigrid::AlignedBuffer<double> field = matrix.layout().field<double>();
  matrix.layout().put(r, 1, field);
  matrix.kernels().to_float(field.data(), matrix.b().data(), static_cast<long>(field.size()));
  matrix.cycle();
  for (size_t i = 0; i < field.size(); ++i) field.data()[i] = matrix.u().data()[i];
  Points z;
  matrix.layout().get(field, 1, z);
  return z;
}

TEST(Multigrid, APreconditionerIsSymmetricAndPositive) {
  for (const auto& [rows, columns] : sizes)
    for (const double heavier : {1., 30., 1e3}) {  // uses all levels, fewer levels, or only the finest one
      SCOPED_TRACE(fmt::format("{} x {}, {} times as heavy", rows, columns, heavier));
      const Problem p(11, rows, columns), other(12, rows, columns);
      multigrid::VCycle matrix(p.topology, p.pins);
      matrix.set(heavier * p.inertia, p.x, Curvature::clamped);
      Points second = other.b;
      for (const int pin : p.pins) second.col(pin).setZero();
      const Points z = cycle(matrix, p.b), w = cycle(matrix, second);
      EXPECT_GT(dot(p.b, z), 0);
      EXPECT_GT(dot(second, w), 0);
      // computed in single precision, with a few hundred consecutive rounding errors
      const double scale = std::sqrt(dot(p.b, z) * dot(second, w));
      EXPECT_NEAR(dot(second, z), dot(p.b, w), 300 * std::numeric_limits<float>::epsilon() * scale);
    }
}

TEST(Multigrid, SameBitsOnEveryAvx) {
  const std::vector<simd::InstructionSet> all = simd::supported_instruction_sets();
  if (all.back() != simd::InstructionSet::avx512) GTEST_SKIP() << "this machine has no AVX-512";
  for (const auto& [rows, columns] : sizes) {
    const Problem p(5, rows, columns);
    Points a, b;
    solve(p, simd::InstructionSet::avx2, Curvature::clamped, 1e-12, a);
    solve(p, simd::InstructionSet::avx512, Curvature::clamped, 1e-12, b);
    EXPECT_EQ(a, b) << rows << " x " << columns;
  }
}

/// Number of iterations for one linear step of a hanging cloth.
int iterations(int side, double rate, bool plain) {
  const Scene scene = hanging_cloth(side);
  Recorder recorder;
  run_method(find_method("mysim/leapfrog+fast"), scene, {scene.step, 0.3, 1}, {&recorder});
  System f(scene.model);
  ImplicitStep step(f, plain);
  step.solve_linear({0, recorder.trajectory.x.back(), recorder.trajectory.v.back()}, 1 / rate);
  return step.iterations();
}

TEST(Multigrid, IterationsHardlyGrowWithTheSheet) {
  for (const double rate : {60.0, 240.0}) {
    const int small = iterations(24, rate, false), large = iterations(96, rate, false);
    const int small_plain = iterations(24, rate, true), large_plain = iterations(96, rate, true);
    // The large cloth is four times as wide. Block-diagonal preconditioning alone needs about four times as many
    // iterations, which is the square root of the ratio of the condition numbers.
    EXPECT_LT(large, 2 * small) << rate;
    EXPECT_GT(large_plain, 3 * small_plain) << rate;
    EXPECT_LT(large, 60) << rate;
  }
}

TEST(ImplicitCloth, StepsAreThoseOfTheListOfPairs) {
  Scene scene = hanging_cloth(24);
  // At the shortest steps inertia dominates, and relaxation alone serves as the preconditioner.
  for (const double h : {1 / 60., 1 / 240., 1 / 1000., 1 / 4000.}) {
    System f(scene.model), g(scene.model);
    ImplicitStep fast(f), plain(g, true);
    State s = scene.start;
    for (int i = 0; i < 12; ++i) {
      const State a = fast.solve(s, h), b = plain.solve(s, h);
      // Both solutions leave forces of 1e-12 of the largest force (or round-off). The stiffness of the softest mode
      // comes from inertia and is m / h^2.
      const double force = std::max(fast.potential().force_scale() * 1e-12, fast.potential().force_rounding());
      const double inertia = 0.25 / (24 * 24) / (h * h);
      EXPECT_LE(largest_column(a.x - b.x), 2 * force / inertia * 24) << i;
      s = a;
    }
    EXPECT_GT(largest_column(s.x - scene.start.x), 40 * h * h);
    EXPECT_LT(fast.iterations(), plain.iterations());
  }
}

TEST(ImplicitCloth, BeyondSinglePrecisionItIsSolvedAllTheSame) {
  constexpr double step = 0.1;  // s
  for (const double stiffer : {1e2, 1e4, 1e6}) {
    const Scene scene = hanging_cloth(24, {400 * stiffer, 200 * stiffer, 20 * stiffer});
    System f(scene.model);
    ImplicitStep implicit(f);
    State s = scene.start;
    Random random(4);
    for (int i = 0; i < s.v.cols(); ++i)
      if (!scene.model.particles.pinned[i]) s.v.col(i) = 0.01 * random.vector();
    IncrementalPotential& p = implicit.potential();
    const Points end = implicit.solve_linear(s, step).x, u = end - p.inertial();
    Points g, product;
    p.gradient(Points::Zero(3, u.cols()), g);
    p.linearise(Points::Zero(3, u.cols()), Curvature::clamped);
    p.apply(u, product);
    // The solver stops at 1e-12 of the right-hand side. Components of u may differ by a factor up to the condition
    // number, so that A u itself has a rounding error of eps |A| |u|. |A| is at most inertia plus twice the sum of the
    // stiffnesses of a particle's springs, for which 8 springs of each family are assumed.
    const double inertia = p.inertia().maxCoeff(), size = inertia + 2 * 8 * 620 * stiffer;
    EXPECT_LE((product + g).norm(), 1e-11 * g.norm() + 10 * eps * size * u.norm()) << stiffer;
    EXPECT_GT(u.norm(), 0);
  }
}

TEST(ImplicitCloth, OnlyWhereSpringsAloneAreStiff) {
  Model model = hanging_cloth(24).model;
  EXPECT_NE(multigrid::make_multigrid_solver(model), nullptr);
  Model damped = model;
  damped.terms.emplace_back(Dashpots{{{0, 1, 1}}});
  EXPECT_EQ(multigrid::make_multigrid_solver(damped), nullptr);
  EXPECT_EQ(multigrid::make_multigrid_solver(hanging_cloth(8).model), nullptr);
  Model holed = model;
  holed.find<Springs>()->list.pop_back();
  EXPECT_EQ(multigrid::make_multigrid_solver(holed), nullptr);
}

}  // namespace
}  // namespace crosscheck
