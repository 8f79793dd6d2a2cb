// Implicit steps: Newton's method with line search on the incremental potential, and its first step alone.
#pragma once

#include <vector>

#include "mysim/implicit/conjugate_gradients.h"
#include "mysim/implicit/incremental_potential.h"

namespace crosscheck {

class ImplicitStep {
 public:
  explicit ImplicitStep(System& f) : potential_(f) {}

  /// Solves the implicit Euler equations of a step of h from s, to round-off or 1e-12 of the forces, whichever is
  /// larger; returns the end state. Throws SolverFailure when Newton's method does not get there.
  const State& solve(const State& s, double h);
  /// One Newton step from y = x_n + h v_n with the clamped matrix; the linear system is solved to 1e-12.
  const State& solve_linear(const State& s, double h);

  /// Values of the incremental potential in the last solve(), J: at the start position, then after each Newton step
  /// (of the last repetition, where air or dashpots ask for several).
  const std::vector<double>& descent() const { return descent_; }
  IncrementalPotential& potential() { return potential_; }

 private:
  void minimise();
  CgResult newton_direction(Curvature curvature, double tolerance);

  IncrementalPotential potential_;
  Points u_, trial_, g_, minus_g_, p_;
  CgMemory cg_;
  std::vector<double> descent_;
};

}  // namespace crosscheck
