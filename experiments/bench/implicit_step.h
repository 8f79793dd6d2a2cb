// A linear implicit Euler step as one writes it on Eigen: the matrix formed, factorised and solved.
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// (M (1/h^2 + gamma/h) + K) u = M (g - gamma v) + F(x + h v) with K the clamped tangent at x + h v, rows and
/// columns of pins left out; then x' = x + h v + u. Springs, gravity and uniform drag; pins that stand still. K is
/// written into a pattern that is made once, with a fill-reducing order that is found once (approximate minimum
/// degree).
class FactorisedStep {
 public:
  /// Throws std::invalid_argument where the drag of particles is no rate that all have.
  FactorisedStep(const Scene& scene, double h);
  /// Positions after a step from x, v (3 x n), m.
  const Points& step(const Points& x, const Points& v);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  /// Where the 3 x 3 block of two particles stands in the lower triangle; -1 where it is not kept.
  struct Places {
    int number[3][3];
  };
  void add(const Places& places, const Eigen::Matrix3d& block);

  std::vector<Spring> springs_;
  Eigen::ArrayXd mass_;
  Vec3 gravity_;
  double h_, gamma_;
  std::vector<int> first_;              // row of each particle; -1 of pins
  std::vector<Places> diagonal_, off_;  // of particles; of springs
  Sparse matrix_;
  Eigen::VectorXd right_;
  Eigen::SimplicialLDLT<Sparse> solver_;
  Points end_;
};

}  // namespace crosscheck
