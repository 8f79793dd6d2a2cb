// Implicit steps: Newton's method with line search on the incremental potential, and its first step alone.
#pragma once

#include <memory>
#include <vector>

#include "mysim/implicit/conjugate_gradients.h"
#include "mysim/implicit/incremental_potential.h"
#include "mysim/multigrid/sheet_solver.h"

namespace crosscheck {

class ImplicitStep {
 public:
  /// Systems of sheets that are large enough are solved with a V-cycle as preconditioner; `plain`: those too by the
  /// list of pairs, which defines what they are.
  explicit ImplicitStep(System& f, bool plain = false);

  /// Solves the implicit Euler equations of a step of h from s, to round-off or 1e-12 of the forces, whichever is
  /// larger; returns the end state. Throws SolverFailure when Newton's method does not get there.
  const State& solve(const State& s, double h);
  /// One Newton step from y = x_n + h v_n with the clamped matrix; the linear system is solved to 1e-12.
  const State& solve_linear(const State& s, double h);

  /// Values of the incremental potential in the last solve(), J: at the start position, then after each Newton step
  /// (of the last repetition, where air or dashpots ask for several).
  const std::vector<double>& descent() const { return descent_; }
  /// Of conjugate gradients, in the last system.
  int iterations() const { return iterations_; }
  IncrementalPotential& potential() { return potential_; }

 private:
  void minimise();
  CgResult newton_direction(Curvature curvature, double tolerance);
  CgResult by_pairs(Curvature curvature, double tolerance);

  IncrementalPotential potential_;
  Points u_, trial_, g_, minus_g_, p_;
  CgMemory cg_;
  int iterations_ = 0;
  std::shared_ptr<multigrid::SheetSolver> sheet_;  // null: solved by pairs; shared by copies, which never step at once
  std::vector<double> descent_;
};

}  // namespace crosscheck
