// Newton's method on the incremental potential.
#include "mysim/implicit/newton.h"

#include <fmt/format.h>

#include "mysim/errors.h"

namespace crosscheck {
namespace {

constexpr int most_newton_steps = 200, most_repetitions = 100;
constexpr double force_tolerance = 1e-12;  // of the largest force; round-off often comes first

}  // namespace

ImplicitStep::ImplicitStep(System& f, bool plain) : potential_(f) {
  if (!plain) sheet_ = multigrid::sheet_solver_of(f.model());
}

/// p_ = -matrix^-1 g at u_.
CgResult ImplicitStep::newton_direction(Curvature curvature, double tolerance) {
  minus_g_ = -g_;
  CgResult result;
  if (sheet_) {
    result = sheet_->solve(potential_.inertia(), potential_.end(u_).x, curvature, minus_g_, tolerance, p_);
    potential_.count(result.iterations * sheet_->products());
  }
  // other networks, and a sheet on which the V-cycle does not help; none such is known
  if (!result.converged && !result.negative_curvature) result = by_pairs(curvature, tolerance);
  iterations_ = result.iterations;
  return result;
}

CgResult ImplicitStep::by_pairs(Curvature curvature, double tolerance) {
  potential_.linearise(u_, curvature);
  // in exact arithmetic as many iterations as unknowns would do
  return conjugate_gradients([&](const Points& p, Points& q) { potential_.apply(p, q); },
                             [&](const Points& r, Points& z) { potential_.precondition(r, z); }, minus_g_, tolerance,
                             3 * static_cast<int>(u_.cols()) + 20, p_, cg_);
}

/// Descends from u_, where the potential is the last of descent_, to the minimum.
void ImplicitStep::minimise() {
  double value = descent_.back();
  for (int step = 0; step < most_newton_steps; ++step) {
    potential_.gradient(u_, g_);
    const double left = largest_column(g_),
                 goal = std::max(force_tolerance * potential_.force_scale(), potential_.force_rounding());
    if (left <= goal) return;

    // far from the minimum a rough direction does; near it the error should fall quadratically
    const double accuracy = std::min(0.1, std::sqrt(left / potential_.force_scale()));
    if (newton_direction(Curvature::exact, accuracy).negative_curvature) newton_direction(Curvature::clamped, accuracy);

    const double slope = dot(g_, p_);
    double length = 1, tried = 0;
    for (;; length /= 2) {
      trial_ = u_ + length * p_;
      tried = potential_.value(trial_);
      if (tried <= value + 1e-4 * length * slope + potential_.rounding()) break;
      if (length < 1e-12)
        throw SolverFailure(
            fmt::format("the line search found no lower potential (force left {:.2g} N, asked {:.2g} N)", left, goal));
    }
    u_ = trial_;
    value = tried;
    descent_.push_back(value);
  }
  throw SolverFailure(fmt::format("Newton's method did not converge in {} steps", most_newton_steps));
}

const State& ImplicitStep::solve(const State& s, double h) {
  potential_.begin(s, h);
  // from where the particles are: the potential there is what the step must not exceed; pins have moved already
  u_ = s.x - potential_.inertial();
  for (int pin : potential_.pins()) u_.col(pin).setZero();
  const bool repeat = potential_.freeze(u_);
  descent_.assign(1, potential_.value(u_));
  // free flight is the better guess where no stiff spring stands in its way
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
    // below the accuracy of the solves themselves nothing more is gained
    change = descent_.size() == 1 ? 0 : largest_column(u_ - before);
  }
  return potential_.end(u_);
}

const State& ImplicitStep::solve_linear(const State& s, double h) {
  potential_.begin(s, h);
  u_.setZero(3, s.x.cols());
  potential_.freeze(u_);
  potential_.gradient(u_, g_);
  if (!newton_direction(Curvature::clamped, 1e-12).converged && largest_column(g_) > potential_.force_rounding())
    throw SolverFailure("the linear system of the step was not solved");
  u_ = p_;
  return potential_.end(u_);
}

}  // namespace crosscheck
