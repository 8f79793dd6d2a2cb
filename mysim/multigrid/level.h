// One of the sheets: its springs, its matrix and the vectors of the V-cycle on it.
#pragma once

#include <vector>

#include "mysim/multigrid/kernels.h"
#include "mysim/multigrid/layout.h"

namespace crosscheck::multigrid {

class Level {
 public:
  /// Springs `times_longer` than those of the weave, and as stiff.
  Level(const Layout& layout, const Weave& weave, double times_longer);

  const Layout& layout() const { return layout_; }
  const Matrix<float>& matrix() const { return matrix_; }
  const Matrix<double>& exact() const { return exact_; }

  Eigen::ArrayXd inertia, free;  // of the particles: N/m; 1 or 0
  Lines<double> x;               // m, a field
  Lines<float> b, u, change, r;  // fields: right side and solution of the V-cycle, and working memory

  void take_inertia();  // from `inertia` and `free`
  /// Clamped stiffness at x, and the inverse blocks on the diagonal.
  void linearise(const Functions& f);
  /// Stiffness as it is, in exact() alone.
  void linearise_exactly(const Functions& f);

 private:
  Layout layout_;
  Shape shape_{};
  Lines<double> k_[directions], springs_[directions], inertia_, free_, blocks_, sums_, force_;
  Lines<float> single_springs_[directions], single_inertia_, single_free_, single_blocks_, single_force_;
  double* spring_lines_[directions] = {};
  Matrix<float> matrix_{};
  Matrix<double> exact_{};
};

}  // namespace crosscheck::multigrid
