// Sums of the terms' forces (N), and the tangent (stiffness and damping matrices) used by implicit methods.
#pragma once

#include <vector>

#include "mysim/types.h"

namespace crosscheck {

struct Forces {
  Points f;                     // N (3 x n)
  long degenerate_springs = 0;  // springs at zero length, which exert no force

  void clear() {
    f.setZero();
    degenerate_springs = 0;
  }
};

enum class Curvature {
  exact,    // exact -dF/dx; indefinite where springs are compressed
  clamped,  // negative parts are omitted, which makes K positive semidefinite
};

/// K = -dF/dx (N/m) and C = -dF/dv (N s/m), both symmetric and never assembled. Each pair of particles a, b applies the
/// 3 x 3 block `across` (I - n n^T) + `along` n n^T to the difference of their displacements. Pins are left to the
/// caller.
class Tangent {
 public:
  struct Pair {
    int a, b;
    Vec3 n;                // unit vector
    double along, across;  // N/m or N s/m
  };
  void clear() { stiffness_.clear(), damping_.clear(); }
  void add_stiffness(const Pair& pair) { stiffness_.push_back(pair); }
  void add_damping(const Pair& pair) { damping_.push_back(pair); }

  /// out += (`stiffness` K + `damping` C) d, with d of 3 x n.
  void add_product(double stiffness, double damping, const Points& d, Points& out) const;
  /// Adds the 3 x 3 blocks on the diagonal of (`stiffness` K + `damping` C) to `blocks` (3 x 3n).
  void add_diagonal(double stiffness, double damping, Eigen::Matrix3Xd& blocks) const;
  bool empty() const { return stiffness_.empty() && damping_.empty(); }
  const std::vector<Pair>& stiffness() const { return stiffness_; }
  const std::vector<Pair>& damping() const { return damping_; }

 private:
  std::vector<Pair> stiffness_, damping_;
};

}  // namespace crosscheck
