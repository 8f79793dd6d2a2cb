// Truth of scenes with hard distances, by Lagrange multipliers without projection.
#pragma once

#include <Eigen/SparseCholesky>

#include "mysim/run/engine.h"

namespace crosscheck {

/// For each distance d = x_a - x_b let g = (|d|^2 - L^2) / 2, and J its derivatives. The accelerations
///   a = M^-1 (f + J^T lambda),  (J M^-1 J^T) lambda = -J M^-1 f - |d'|^2,
/// keep g'' = 0 (index reduction; E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, VII.1). With
/// rk4, the distances drift only by the rule's error of order 4. Forces are computed by the terms' plain loops.
class MultiplierWorld : public World {
 public:
  /// Throws Unsupported if the distances depend on each other (a straight row between two pins, or a closed mesh).
  MultiplierWorld(const Scene& scene, double h);
  void step(double t, double t_next) override;
  const State& state(double) override { return s_; }

  /// Velocities and accelerations at the stage; the world's state is unchanged.
  void derivative(const State& stage, State& rate);

 private:
  const Scene& scene_;
  const Constraints& constraints_;
  double h_;
  State s_, stage_, k_[4];
  Forces forces_;
  Eigen::VectorXd inverse_mass_;  // 3 n, 0 at pins
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace crosscheck
