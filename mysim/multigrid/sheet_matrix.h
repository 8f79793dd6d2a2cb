// The matrix of a sheet, and the V-cycle over the coarser sheets under it.
#pragma once

#include <vector>

#include "mysim/multigrid/level.h"
#include "mysim/tangent.h"

namespace crosscheck::multigrid {

class SheetMatrix {
 public:
  SheetMatrix(const Weave& weave, const std::vector<int>& pins);

  /// inertia: of each particle, N/m; x: positions, m (3 x n).
  void set(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature);

  const Functions& functions() const { return functions_; }
  const Layout& layout() const { return levels_.front().layout(); }
  const Matrix<double>& exact() const { return levels_.front().exact(); }

  /// Right side and solution of one V-cycle: fields.
  Lines<float>& b() { return levels_.front().b; }
  const Lines<float>& u() const { return levels_.front().u; }
  void cycle() { cycle(0); }
  /// Products that a cycle takes, those of coarse sheets by their number of particles.
  double products() const;

 private:
  /// From a sheet to the next.
  struct Step {
    Transfer transfer{};
    Lines<float> right, left;
  };
  static Step step(const Layout& fine, const Layout& coarse);
  void set_inertia(const Eigen::ArrayXd& inertia);
  void cycle(size_t level);

  Functions functions_;
  std::vector<Level> levels_;
  std::vector<Step> steps_;
  Eigen::ArrayXd inertia_;  // of the particles, as last set
};

}  // namespace crosscheck::multigrid
