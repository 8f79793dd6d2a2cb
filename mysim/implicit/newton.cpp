#include "mysim/implicit/newton.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <cassert>
#include <limits>

#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

IncrementalPotential::IncrementalPotential(System& f) : f_(f), model_(f.model()) {
  const int n = model_.particles.size();
  drag_ = f.drag_rate() * model_.particles.mass.array();
  a_ = moved_ = Points::Zero(3, n);
  frozen_air_.f = Points::Zero(3, n);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n);
  const auto add_spring = [&](int a, int b, double k) {
    sum[a] += std::abs(k);
    sum[b] += std::abs(k);
    stiffness_ += std::abs(k);
  };
  if (const auto* springs = model_.find<Springs>())
    for (const Spring& s : springs->list) add_spring(s.a, s.b, s.k);
  if (const auto* bending = model_.find<Bending>()) for_each_pair(*bending, add_spring);
  stiffest_ = sum.maxCoeff();
}

void IncrementalPotential::clear_pins(Points& p) const {
  for (int pin : model_.particles.pins) p.col(pin).setZero();
}

void IncrementalPotential::begin(const State& start, double h) {
  assert(h > 0 && start.v.cols() == start.x.cols());
  start_ = end_ = start;
  h_ = h;
  end_.t = start.t + h;
  end_.x += h * start.v;
  model_.particles.place_pins(end_);
  y_ = end_.x;
  inertia_ = model_.particles.mass.array() / (h * h) + drag_ / h;
}

State& IncrementalPotential::end(const Points& u) {
  assert(u.cols() == y_.cols());  // begin() came before
  end_.x = y_ + u;
  end_.v = start_.v + u / h_;
  model_.particles.place_pin_velocities(end_);
  return end_;
}

bool IncrementalPotential::freeze(const Points& u) {
  frozen_air_.clear();
  frozen_damping_.clear();
  bool any = false;
  const State& at = end(u);
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (UsesVelocity<T>) {
            any = true;
            if constexpr (HasTangent<T>)
              add_tangent(t, model_.particles, at, Curvature::exact, frozen_damping_);
            else
              add_force(t, model_.particles, at, frozen_air_);
          }
        },
        term);
  if (any) f_.count(1);
  return any;
}

double IncrementalPotential::value(const Points& u) {
  const Particles& particles = model_.particles;
  const State& at = end(u);
  moved_ = h_ * at.v;
  double inertia = 0, drag = 0;
  for (int i = 0; i < particles.size(); ++i) {
    if (particles.pinned[i]) continue;
    inertia += particles.mass[i] / (2 * h_ * h_) * u.col(i).squaredNorm();
    drag += drag_[i] / (2 * h_) * moved_.col(i).squaredNorm();
  }
  // `given_size` sums magnitudes, because the parts of `given` cancel if heights have both signs
  double springs = 0, given = 0, given_size = 0;
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (std::is_same_v<T, Springs> || std::is_same_v<T, Bending>)
            springs += potential_energy(t, particles, at);
          else if constexpr (HasPotential<T>)
            given += potential_energy(t, particles, at);
          if constexpr (std::is_same_v<T, Gravity>)
            for (int i = 0; i < particles.size(); ++i)
              given_size += particles.mass[i] * std::abs(t.acceleration.dot(at.x.col(i)));
        },
        term);
  if (const auto* wind = model_.find<Wind>()) {
    const Vec3 w = wind->acceleration.at(at.t);
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) {
        const double part = particles.mass[i] * w.dot(at.x.col(i));
        given -= part, given_size += std::abs(part);
      }
  }
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) {
      const double part = frozen_air_.f.col(i).dot(at.x.col(i));
      given -= part, given_size += std::abs(part);
    }
  a_.setZero();
  frozen_damping_.add_product(0, 1, moved_, a_);
  const double dashpots = dot(moved_, a_) / (2 * h_);
  // A sum of n parts is rounded by at most n eps times the sum of their magnitudes, and each part, a dot product of
  // 3-vectors, by at most 8 eps. A spring's energy is rounded by k |e| eps |x|, because its end points are rounded, and
  // sum k |e| <= sqrt(sum k e^2) sqrt(sum k).
  rounding_ = (particles.size() + 8) * eps * (inertia + drag + dashpots + springs + given_size) +
              8 * eps * std::sqrt(2 * springs * stiffness_) * at.x.cwiseAbs().maxCoeff();
  return inertia + drag + dashpots + springs + given;
}

void IncrementalPotential::gradient(const Points& u, Points& g) {
  const Particles& particles = model_.particles;
  State& at = end(u);
  moved_ = h_ * at.v;
  f_.position_acceleration(at, a_);
  g.setZero(3, particles.size());
  frozen_damping_.add_product(0, 1 / h_, moved_, g);
  double scale = 0;  // N^2
  for (int i = 0; i < particles.size(); ++i) {
    if (particles.pinned[i]) continue;
    const double m = particles.mass[i];
    const Vec3 inertia = m / (h_ * h_) * u.col(i), drag = drag_[i] / h_ * moved_.col(i);
    scale = std::max({scale, m * m / (h_ * h_) * start_.v.col(i).squaredNorm(), inertia.squaredNorm(),
                      m * m * a_.col(i).squaredNorm()});
    g.col(i) += inertia + drag - m * a_.col(i) - frozen_air_.f.col(i);
  }
  force_scale_ = std::sqrt(scale);
  clear_pins(g);
  // spring forces depend on positions, which are rounded by eps |x|
  force_rounding_ = 8 * eps * (stiffest_ * at.x.cwiseAbs().maxCoeff() + largest_column(a_) * particles.mass.maxCoeff());
}

void IncrementalPotential::linearise(const Points& u, Curvature curvature) {
  const State& at = end(u);
  tangent_.clear();
  add_stiffness(model_, at, curvature, tangent_);
  const int n = model_.particles.size();
  blocks_.setZero(3, 3 * n);
  tangent_.add_diagonal(1, 0, blocks_);
  frozen_damping_.add_diagonal(0, 1 / h_, blocks_);
  for (int i = 0; i < n; ++i) {
    auto block = blocks_.middleCols<3>(3 * i);
    block.diagonal().array() += inertia_[i];
    block = block.inverse().eval();
  }
}

void IncrementalPotential::apply(const Points& p, Points& out) {
  assert(p.cols() == inertia_.size());
  out = p * inertia_.matrix().asDiagonal();
  tangent_.add_product(1, 0, p, out);
  frozen_damping_.add_product(0, 1 / h_, p, out);
  clear_pins(out);
  f_.count(1);
}

void IncrementalPotential::precondition(const Points& r, Points& out) const {
  assert(blocks_.cols() == 3 * r.cols());  // linearise() came before
  out.resize(3, r.cols());
  for (int i = 0; i < r.cols(); ++i) out.col(i) = blocks_.middleCols<3>(3 * i) * r.col(i);
  clear_pins(out);
}

namespace {

constexpr int most_repetitions = 100;
/// At least 200 steps, and more if there are few particles: a strut of stiff springs buckles in many short descending
/// steps, because each step that turns its springs stretches them to second order. With few particles these steps are
/// cheap.
int most_newton_steps(long particles) { return static_cast<int>(std::max(200L, 100'000 / particles)); }
/// Most cloths need ten steps. Following negative curvature far from a minimum may be a detour, and is reserved for
/// solves that need more steps than this.
constexpr int few_newton_steps = 20;

}  // namespace

ImplicitStep::ImplicitStep(System& f, bool plain) : potential_(f) {
  if (!plain) multigrid_ = multigrid::make_multigrid_solver(f.model());
}

CgResult ImplicitStep::newton_direction(Curvature curvature, double tolerance) {
  minus_g_ = -g_;
  CgResult result;
  if (multigrid_) {
    result = multigrid_->solve(potential_.inertia(), potential_.end(u_).x, curvature, minus_g_, tolerance, p_);
    potential_.count(result.iterations * multigrid_->products());
  }
  // the list of pairs serves other spring graphs, and cloths on which the V-cycle fails (none is known)
  if (!result.converged && !result.negative_curvature) result = by_pairs(curvature, tolerance);
  iterations_ = result.iterations;
  return result;
}

CgResult ImplicitStep::by_pairs(Curvature curvature, double tolerance) {
  potential_.linearise(u_, curvature);
  // in exact arithmetic, as many iterations as unknowns suffice
  return conjugate_gradients([&](const Points& p, Points& q) { potential_.apply(p, q); },
                             [&](const Points& r, Points& z) { potential_.precondition(r, z); }, minus_g_, tolerance,
                             3 * static_cast<int>(u_.cols()) + 20, p_, cg_);
}

/// Moves from u_ along the direction of negative curvature to the lowest potential found, and returns this potential.
/// The first length is that of the last Newton step, which is short near a saddle, because the gradient is small. The
/// length is doubled as long as the potential does not rise: at first it falls by less than its rounding error.
double ImplicitStep::leave_saddle(double value, double step) {
  const double size = largest_column(downhill_);
  potential_.gradient(u_, g_);
  if (dot(g_, downhill_) > 0) downhill_ = -downhill_;
  double lowest = value, best = 0;
  for (double length = step / size; size > 0 && step > 0; length *= 2) {
    trial_ = u_ + length * downhill_;
    const double tried = potential_.value(trial_);
    if (!(tried <= lowest + potential_.rounding())) break;
    if (tried < lowest) lowest = tried, best = length;
  }
  u_ += best * downhill_;
  return lowest;
}

/// Descends from u_ to the minimum. The last entry of descent_ must be the potential at u_.
void ImplicitStep::minimise() {
  assert(!descent_.empty());
  double value = descent_.back();
  const int most = most_newton_steps(u_.cols());
  for (int step = 0; step < most; ++step) {
    potential_.gradient(u_, g_);
    const double left = largest_column(g_),
                 goal = std::max(force_tolerance * potential_.force_scale(), potential_.force_rounding());
    if (left <= goal) return;

    // a rough direction suffices far from the minimum; near it convergence should be quadratic
    const double accuracy = std::min(0.1, std::sqrt(left / potential_.force_scale()));
    const bool saddle = newton_direction(Curvature::exact, accuracy).negative_curvature;
    if (saddle) {
      downhill_.swap(p_);
      newton_direction(Curvature::clamped, accuracy);
    }

    const double slope = dot(g_, p_);
    double length = 1, tried = 0;
    for (;; length /= 2) {
      trial_ = u_ + length * p_;
      tried = potential_.value(trial_);
      if (tried <= value + 1e-4 * length * slope + potential_.rounding()) break;
      if (length < 1e-12)
        throw SolverFailure(fmt::format(
            "the line search found no lower potential (residual force {:.2g} N, tolerance {:.2g} N)", left, goal));
    }
    u_ = trial_;
    value = tried;
    if (saddle && step >= few_newton_steps) value = leave_saddle(value, length * largest_column(p_));
    descent_.push_back(value);
  }
  throw SolverFailure(fmt::format("Newton's method did not converge in {} steps", most));
}

const State& ImplicitStep::solve(const State& s, double h) {
  potential_.begin(s, h);
  // The initial guess is the current position, whose potential the step must not exceed. Pins have already moved.
  u_ = s.x - potential_.inertial();
  for (int pin : potential_.pins()) u_.col(pin).setZero();
  const bool repeat = potential_.freeze(u_);
  descent_.assign(1, potential_.value(u_));
  // free flight is the better guess unless stiff springs oppose it
  trial_.setZero(3, u_.cols());
  if (const double flown = potential_.value(trial_); flown < descent_.back()) {
    u_ = trial_;
    descent_.push_back(flown);
  }
  minimise();
  double change = INFINITY;
  for (int i = 0; repeat && change > 0; ++i) {
    if (i == most_repetitions) throw SolverFailure("the forces on moving particles did not settle within the step");
    const Points before = u_;
    potential_.freeze(u_);
    descent_.assign(1, potential_.value(u_));
    minimise();
    // stops at changes that are smaller than the accuracy of the solves
    change = descent_.size() == 1 ? 0 : largest_column(u_ - before);
  }
  return potential_.end(u_);
}

const State& ImplicitStep::solve_linear(const State& s, double h) {
  potential_.begin(s, h);
  u_.setZero(3, s.x.cols());
  potential_.freeze(u_);
  potential_.gradient(u_, g_);
  if (!newton_direction(Curvature::clamped, force_tolerance).converged &&
      largest_column(g_) > potential_.force_rounding())
    throw SolverFailure("the solver of the step's linear system did not converge");
  u_ = p_;
  return potential_.end(u_);
}

}  // namespace crosscheck
