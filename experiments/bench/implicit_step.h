// A linear implicit Euler step written with Eigen: the matrix is formed, factorised and solved.
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// Solves (M (1/h^2 + gamma/h) + K) u = M (g - gamma v) + F(x + h v) for the free particles, where K is the clamped
/// tangent at x + h v. The new positions are x + h v + u. Supports springs, gravity, uniform drag and fixed pins. The
/// sparsity pattern of K and its fill-reducing order (approximate minimum degree) are computed once.
class FactorisedStep {
 public:
  /// Throws std::invalid_argument if the drag rate differs among particles.
  FactorisedStep(const Scene& scene, double h);
  /// Positions after a step from x, v (3 x n), m. Valid until the next call.
  const Points& step(const Points& x, const Points& v);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  /// For each entry of the 3 x 3 block of two particles: index among the matrix's stored values; -1 if not stored.
  struct Places {
    int number[3][3];
  };
  void add(const Places& places, const Eigen::Matrix3d& block);

  std::vector<Spring> springs_;
  Eigen::ArrayXd mass_;
  Vec3 gravity_;
  double h_, gamma_;
  std::vector<int> first_;              // first row of each particle in the matrix; -1 for pins
  std::vector<Places> diagonal_, off_;  // for each particle; for each spring
  Sparse matrix_;
  Eigen::VectorXd right_;
  Eigen::SimplicialLDLT<Sparse> solver_;
  Points end_;
};

}  // namespace crosscheck
