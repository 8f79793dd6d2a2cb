#include "experiments/stability/spectrum.h"

#include <Eigen/SparseCholesky>

#include <cmath>

#include "experiments/measures.h"
#include "experiments/stability/extreme_eigenvalues.h"
#include "mysim/base/errors.h"
#include "mysim/base/random.h"
#include "mysim/eigenvalues.h"
#include "mysim/model/system.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse assembled(const std::vector<Tangent::Pair>& pairs, const std::vector<int>& row_of, const Eigen::VectorXd& root) {
  std::vector<Eigen::Triplet<double>> parts;
  for (const Tangent::Pair& p : pairs) {
    const Eigen::Matrix3d block = p.across * Eigen::Matrix3d::Identity() + (p.along - p.across) * p.n * p.n.transpose();
    for (const int a : {p.a, p.b})
      for (const int b : {p.a, p.b})
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            const int row = row_of[3 * a + i], column = row_of[3 * b + j];
            if (i != j && p.along == p.across) continue;  // the block is a multiple of the identity
            if (row < 0 || column < 0) continue;
            parts.emplace_back(row, column, (a == b ? 1 : -1) * block(i, j) / (root[row] * root[column]));
          }
  }
  Sparse matrix(root.size(), root.size());
  matrix.setFromTriplets(parts.begin(), parts.end());
  return matrix;
}

double root_or_zero(double square) { return std::sqrt(std::max(0.0, square)); }

void dense_modes(Spectrum& s, double gamma) {
  const Eigensystem dense = symmetric_eigensystem(Eigen::MatrixXd(s.system.k));
  s.shapes = dense.vectors;
  for (const double w2 : dense.values) s.modes.push_back({root_or_zero(w2), gamma});
}

void extreme_modes(Spectrum& s, double gamma) {
  const auto fast = largest_eigenpair(s.system.k, 1e-10);
  if (!fast) throw SolverFailure("the fastest mode was not found");
  // the shift is below zero, so that a free motion does not make the matrix singular
  const auto slow = eigenpair_above(s.system.k, -1e-6 * fast->value, 1e-8);
  if (!slow) throw SolverFailure("the slowest mode was not found");
  s.modes = {{root_or_zero(slow->value), gamma}, {root_or_zero(fast->value), gamma}};
  s.shapes.resize(s.system.size(), 2);
  s.shapes << slow->vector, fast->vector;
  s.complete = false;
}

/// Computes the modes from the eigenvalues of ((0, I), (-K, -C)).
void quadratic_modes(Spectrum& s) {
  const int n = s.system.size();
  const Sparse c = s.system.damping();
  Eigen::VectorXcd rates;
  if (n <= 200) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = -Eigen::MatrixXd(s.system.k);
    a.bottomRightCorner(n, n) = -Eigen::MatrixXd(c);
    rates = eigenvalues(a);
  } else {
    // uses velocities in units of the fastest mode, so that both halves have the same scale
    const double unit = s.omega;
    std::vector<Eigen::Triplet<double>> parts;
    for (int i = 0; i < n; ++i) parts.emplace_back(i, n + i, unit);
    for (int i = 0; i < n; ++i) {
      for (Sparse::InnerIterator it(s.system.k, i); it; ++it)
        parts.emplace_back(n + it.row(), it.col(), -it.value() / unit);
      for (Sparse::InnerIterator it(c, i); it; ++it) parts.emplace_back(n + it.row(), n + it.col(), -it.value());
    }
    Sparse a(2 * n, 2 * n);
    a.setFromTriplets(parts.begin(), parts.end());
    const auto found = largest_eigenvalues(a, 4, 1e-8);
    if (!found) throw SolverFailure("the fastest rates were not found");
    rates = *found;
    s.complete = false;
  }
  for (const std::complex<double> z : rates)
    if (z.imag() >= 0) s.modes.push_back({std::abs(z), std::max(0.0, -2 * z.real())});
  std::sort(s.modes.begin(), s.modes.end(), [](const Vibration& a, const Vibration& b) { return a.omega < b.omega; });
  s.commuting = false;
}

}  // namespace

Sparse Linearised::damping() const {
  Sparse c = dashpots;
  for (int i = 0; i < size(); ++i) c.coeffRef(i, i) += drag[i];
  return c;
}

Points Linearised::offsets(const Eigen::VectorXd& w, int particles) const {
  Points u = Points::Zero(3, particles);
  for (int i = 0; i < size(); ++i) u(free[i] % 3, free[i] / 3) = w[i] / root_mass[i];
  return u;
}

Eigen::VectorXd Linearised::weighted(const Points& u) const {
  Eigen::VectorXd w(size());
  for (int i = 0; i < size(); ++i) w[i] = u(free[i] % 3, free[i] / 3) * root_mass[i];
  return w;
}

Linearised linearised(const Model& model, const State& state) {
  const Particles& particles = model.particles;
  Linearised l;
  std::vector<int> row_of(3 * particles.size(), -1);
  for (int i = 0; i < particles.size(); ++i)
    for (int axis = 0; axis < 3 && !particles.pinned[i]; ++axis) {
      row_of[3 * i + axis] = l.size();
      l.free.push_back(3 * i + axis);
    }
  l.root_mass.resize(l.size());
  l.drag = Eigen::VectorXd::Zero(l.size());
  const auto* drag = model.find<Drag>();
  for (int i = 0; i < l.size(); ++i) {
    const double mass = particles.mass[l.free[i] / 3];
    l.root_mass[i] = std::sqrt(mass);
    if (drag) l.drag[i] = drag->c[l.free[i] / 3] / mass;
  }
  Tangent tangent;
  add_stiffness(model, state, Curvature::exact, tangent);
  if (const auto* dashpots = model.find<Dashpots>())
    add_tangent(*dashpots, particles, state, Curvature::exact, tangent);
  l.k = assembled(tangent.stiffness(), row_of, l.root_mass);
  l.dashpots = assembled(tangent.damping(), row_of, l.root_mass);
  return l;
}

Spectrum spectrum_of(const Scene& scene, const State& state) {
  Spectrum s;
  if (const auto* rotation = scene.model.find<Rotation>()) {
    s.omega = std::abs(rotation->rate);
    s.modes = {{s.omega, 0}};
    return s;
  }
  s.system = linearised(scene.model, state);
  const auto gamma = uniform_drag_rate(scene.model);
  const int n = s.system.size();
  if (n == 0) return s;
  const bool springs = s.system.k.nonZeros() > 0;
  if (n <= 400 || !springs)
    dense_modes(s, gamma.value_or(0));
  else
    extreme_modes(s, gamma.value_or(0));
  s.omega = s.modes.back().omega;
  s.fastest = s.shapes.col(s.shapes.cols() - 1);
  if (gamma && !s.system.has_dashpots()) return s;
  s.modes.clear();
  s.shapes.resize(0, 0);
  quadratic_modes(s);
  return s;
}

namespace {

/// Largest ratio of a spring's stiffness to a particle's mass, 1/s^2: the acceleration per extension that a spring
/// could cause.
double stiffest_of(const Model& model) {
  double stiffest = 0;
  for (const Spring& spring : model.find<Springs>()->list)
    for (const int end : {spring.a, spring.b})
      if (!model.particles.pinned[end]) stiffest = std::max(stiffest, spring.k / model.particles.mass[end]);
  return stiffest;
}

/// An equilibrium (rest or saddle), accurate to the last digits.
std::optional<State> converged_rest(const Scene& scene) {
  const Model& model = scene.model;
  auto rest = rest_of(scene);
  if (!rest) return std::nullopt;
  State s = std::move(*rest);
  System f(model);
  Points a(3, s.x.cols());
  const double stiffest = stiffest_of(model);
  Workspace w(s);
  try {
    // takes implicit Euler steps that are so long that they act as damped Newton steps towards the rest
    f.acceleration(s, a);
    for (int i = 0; i < 300 && largest_column(a) > 1e-12 * stiffest * scene.size(); ++i) {
      implicit_euler(f, s, 5, w);
      s.t = 0;
      s.v.setZero();
      f.acceleration(s, a);
    }
  } catch (const SolverFailure&) {
    return std::nullopt;
  }
  // the steps stop at 1e-10 of the forces; perturbations as small as 1e-8 of a spring need a more precise rest
  for (double left = largest_column(a); left > 0;) {
    const Linearised l = linearised(model, s);
    Sparse k = l.k;
    // shifts the matrix, so that a free motion does not make it singular
    for (int i = 0; i < l.size(); ++i) k.coeffRef(i, i) += 1e-9 * stiffest;
    const Eigen::SimplicialLDLT<Sparse> solver(k);
    if (solver.info() != Eigen::Success) return std::nullopt;
    State next = s;
    next.x += l.offsets(solver.solve(l.weighted(a)), static_cast<int>(s.x.cols()));
    f.acceleration(next, a);
    if (!(largest_column(a) < 0.5 * left)) break;
    left = largest_column(a);
    s = std::move(next);
  }
  f.acceleration(s, a);
  if (!(largest_column(a) <= 1e-11 * stiffest * scene.size())) return std::nullopt;
  return s;
}

/// True if the stiffness is negative in some direction: K then has a negative pivot, because its pivots have the signs
/// of its eigenvalues (J. J. Sylvester, 1852). Adds a billionth of the largest stiffness to allow for rounding.
bool is_saddle(const Model& model, const State& state) {
  const Linearised l = linearised(model, state);
  const double rounding = 1e-9 * stiffest_of(model);
  Sparse k = l.k;
  for (int i = 0; i < l.size(); ++i) k.coeffRef(i, i) += rounding;
  const Eigen::SimplicialLDLT<Sparse> solver(k);
  return solver.info() != Eigen::Success || (solver.vectorD().array() < 0).any();
}

}  // namespace

Equilibrium equilibrium_of(const Scene& scene) {
  if (scene.model.first_order()) return {State{0, Points::Zero(3, scene.start.x.cols()), scene.start.v}};
  auto rest = converged_rest(scene);
  if (!rest) return {};
  if (!is_saddle(scene.model, *rest)) return {std::move(rest)};
  double shortest = scene.size();
  for (const Spring& s : scene.model.find<Springs>()->list)
    if (s.rest > 0) shortest = std::min(shortest, s.rest);
  std::mt19937_64 engine(1);
  for (const double push : {0.01, 0.03, 0.1}) {
    Scene pushed = scene;
    pushed.start = *rest;
    for (int i = 0; i < pushed.start.x.cols(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double part = push * shortest * (2 * uniform(engine) - 1);
        if (!scene.model.particles.pinned[i]) pushed.start.x(axis, i) += part;
      }
    if (auto beside = converged_rest(pushed); beside && !is_saddle(scene.model, *beside))
      return {std::move(beside), true};
  }
  return {std::nullopt, true};
}

}  // namespace crosscheck
