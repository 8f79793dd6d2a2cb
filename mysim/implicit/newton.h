// Implicit steps: Newton's method with line search on the incremental potential.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "mysim/forces.h"
#include "mysim/implicit/multigrid/solver.h"
#include "mysim/model/system.h"

namespace crosscheck {

/// With y = x_n + h v_n and the unknown u = x - y (0 at pins, which are already at their positions at the end of the
/// step),
///   P(u) = sum_i m_i |u_i|^2 / (2 h^2) + c_i |h v_n + u|_i^2 / (2 h)        inertia and drag
///        + V(x) - sum_i m_i w . x_i - f_i . x_i                             springs, bending, gravity, wind, air
///        + sum_d c_d (n_d . (moved_a - moved_b))^2 / (2 h)                  dashpots, moved = h v (x - x_n when free)
/// is the incremental potential: its gradient is the residual of the implicit Euler equations (J. Martin et al., ACM
/// Trans. Graph. 30 (4), 2011). The forces f of the air and the dashpots' directions n_d do not derive from an energy.
/// They are frozen at a given position, and the caller updates them and repeats the solve until the result no longer
/// changes.
class IncrementalPotential {
 public:
  explicit IncrementalPotential(System& f);

  /// Starts a step of h (s).
  void begin(const State& start, double h);
  /// Freezes air and dashpot directions at x = y + u. Returns true if there are any.
  bool freeze(const Points& u);

  double value(const Points& u);                             // J, up to a constant
  double rounding() const { return rounding_; }              // J, bound on the rounding error of the last value()
  void gradient(const Points& u, Points& g);                 // N; 0 at pins. Costs one evaluation
  double force_rounding() const { return force_rounding_; }  // N, bound on the rounding error of the last gradient()
  double force_scale() const { return force_scale_; }        // N, largest contribution to the last gradient()

  /// Assembles the matrix M/h^2 + C/h + K of second derivatives at u.
  void linearise(const Points& u, Curvature curvature);
  void apply(const Points& p, Points& out);               // out = matrix times p. Costs one evaluation
  void precondition(const Points& r, Points& out) const;  // by the inverse 3 x 3 diagonal blocks

  const Eigen::ArrayXd& inertia() const { return inertia_; }  // N/m, contribution of each particle to the matrix
  /// Counts matrix products computed elsewhere.
  void count(double products) { f_.count(std::lround(products)); }

  const Points& inertial() const { return y_; }  // y, m
  const std::vector<int>& pins() const { return model_.particles.pins; }
  State& end(const Points& u);  // x = y + u, v = v_n + u / h at t + h

 private:
  void clear_pins(Points& p) const;

  System& f_;
  const Model& model_;
  Eigen::ArrayXd drag_;   // n values of c, N s/m
  double stiffness_ = 0;  // N/m, sum over all springs, including those of bending stencils
  double stiffest_ = 0;   // N/m, largest sum over the springs of a particle
  State start_, end_;
  double h_ = 0;
  Points y_, moved_, a_;
  Forces frozen_air_;
  Tangent frozen_damping_;   // dashpots along the frozen directions
  Eigen::ArrayXd inertia_;   // n values of m / h^2 + c / h, N/m
  Tangent tangent_;          // springs, bending
  Eigen::Matrix3Xd blocks_;  // 3 x 3n, inverse
  double rounding_ = 0, force_rounding_ = 0, force_scale_ = 0;
};

/// Relative residual tolerance of the implicit solve, scaled by the largest force (inertia m v / h included). Often
/// limited by round-off.
inline constexpr double force_tolerance = 1e-12;

class ImplicitStep {
 public:
  /// Linear systems of large regular cloths are solved with the V-cycle as preconditioner. With `plain`, or on other
  /// models, products use the list of pairs, which defines the system.
  explicit ImplicitStep(System& f, bool plain = false);

  /// Solves the implicit Euler equations for a step of h seconds from state `s`, until the residual is below
  /// force_tolerance or round-off, whichever is larger. Returns the end state. Throws SolverFailure if Newton's method
  /// does not converge.
  const State& solve(const State& s, double h);
  /// One Newton step from y = x_n + h v_n with the clamped matrix, to force_tolerance.
  const State& solve_linear(const State& s, double h);

  /// Incremental potential (J) in the last solve(): at the start position, then after each Newton step (of the last
  /// repetition, if air or dashpots require several).
  const std::vector<double>& descent() const { return descent_; }
  /// Iterations in the last linear system.
  int iterations() const { return iterations_; }
  IncrementalPotential& potential() { return potential_; }

 private:
  void minimise();
  double leave_saddle(double value, double step);
  CgResult newton_direction(Curvature curvature, double tolerance);
  CgResult by_pairs(Curvature curvature, double tolerance);

  IncrementalPotential potential_;
  Points u_, trial_, g_, minus_g_, p_, downhill_;
  CgMemory cg_;
  int iterations_ = 0;
  std::shared_ptr<multigrid::MultigridSolver>
      multigrid_;  // null: use the pairs. Copies share it, but never step simultaneously
  std::vector<double> descent_;
};

}  // namespace crosscheck
