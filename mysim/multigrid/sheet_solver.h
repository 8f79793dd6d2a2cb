// Conjugate gradients for the systems of implicit steps on a sheet.
#pragma once

#include <memory>

#include "mysim/implicit/conjugate_gradients.h"
#include "mysim/model.h"
#include "mysim/multigrid/sheet_matrix.h"

namespace crosscheck::multigrid {

class SheetSolver {
 public:
  SheetSolver(const Weave& weave, const std::vector<int>& pins);

  /// Solves (inertia + K(x)) u = b for u (3 x n), until |b - A u| <= tolerance |b|. `inertia` (N/m) is of each
  /// particle, x (m) and b (N) are 3 x n; pins do not move. As conjugate_gradients (mysim/implicit): what is left is
  /// the recurrence's, and the solve stops at once at negative curvature. Gives up after 500 iterations, ten times what
  /// sheets are known to take.
  CgResult solve(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature, const Points& b, double tolerance,
                 Points& u);

  /// Products with the matrix that an iteration takes, those of coarse sheets by their size.
  double products() const { return 1 + matrix_.products(); }

 private:
  SheetMatrix matrix_;
  Lines<double> u_, r_, p_, q_;
};

/// Null unless the model is a sheet, large enough, whose springs alone have a stiffness.
std::unique_ptr<SheetSolver> sheet_solver_of(const Model& model);

}  // namespace crosscheck::multigrid
