// Linear solvers of implicit steps: conjugate gradients, alone or preconditioned by a multigrid V-cycle on a cloth.
#pragma once

#include <cassert>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mysim/forces.h"
#include "mysim/implicit/multigrid/multigrid_kernels.h"
#include "mysim/model/model.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/types.h"

namespace crosscheck {

struct CgResult {
  int iterations = 0;
  bool converged = false;
  bool negative_curvature = false;  // found a direction p with p . A p <= 0: the matrix is not positive definite
};

struct CgMemory {
  Points r, z, p, q;
};

/// Solves A x = b by preconditioned conjugate gradients, from x = 0 until |b - A x| <= tolerance |b|. Vectors are 3 x
/// n. apply(p, q) sets q = A p, with A symmetric. precondition(r, z) sets z = M^-1 r, with M symmetric positive
/// definite. Stops at a direction of negative curvature and returns this direction in x.
template <class Apply, class Precondition>
CgResult conjugate_gradients(Apply apply, Precondition precondition, const Points& b, double tolerance,
                             int most_iterations, Points& x, CgMemory& m) {
  assert(tolerance > 0 && most_iterations > 0);
  CgResult result;
  x.setZero(3, b.cols());
  m.r = b;
  const double goal = tolerance * b.norm();
  precondition(m.r, m.z);
  m.p = m.z;
  double rz = dot(m.r, m.z);
  while (!(result.converged = m.r.norm() <= goal) && result.iterations < most_iterations) {
    apply(m.p, m.q);
    const double curvature = dot(m.p, m.q);
    ++result.iterations;
    if (!(curvature > 0)) {
      result.negative_curvature = true;
      x = m.p;
      break;
    }
    const double length = rz / curvature;
    x += length * m.p;
    m.r -= length * m.q;
    precondition(m.r, m.z);
    const double before = std::exchange(rz, dot(m.r, m.z));
    m.p = m.z + rz / before * m.p;
  }
  return result;
}

}  // namespace crosscheck

namespace crosscheck::multigrid {

Kernels kernels(simd::InstructionSet isa);

// Places a cloth's particles in lanes, and converts to and from this layout.

using simd::AlignedBuffer;
using simd::GridTopology;

struct Layout {
  int rows, columns, tiles;

  /// The number of tiles can be halved down to one or three; at most a third of the lanes stays empty.
  static Layout of(const GridTopology& topology);
  Layout coarsened() const { return {(rows + 1) / 2, (columns + 1) / 2, tiles / 2}; }
  bool can_coarsen() const { return tiles % 2 == 0 && rows > 2; }

  long all_lanes() const { return static_cast<long>(rows) * tiles * lanes; }
  long row_length() const { return static_cast<long>(left_halo + tiles + right_halo) * 3 * lanes; }
  template <class T>
  AlignedBuffer<T> field() const {
    return AlignedBuffer<T>(static_cast<size_t>(rows) * row_length());
  }

  /// Calls take(particle, position in rows x tiles x lanes, position of its first component in a field).
  template <class Take>
  void each(Take take) const {
    for (int row = 0; row < rows; ++row)
      for (int lane = 0, column = 0; column < columns; ++lane)
        for (int tile = 0; tile < tiles && column < columns; ++tile, ++column)
          take(row * columns + column, (static_cast<long>(row) * tiles + tile) * lanes + lane,
               row * row_length() + static_cast<long>(left_halo + tile) * 3 * lanes + lane);
  }
  /// Copies every second row and column, without the halo.
  void inject(const AlignedBuffer<double>& fine, AlignedBuffer<double>& coarse) const;
  /// put() copies points times `factor` into a field, without its halo; get() copies a field times `factor` back.
  void put(const Points& points, double factor, AlignedBuffer<double>& field) const;
  void get(const AlignedBuffer<double>& field, double factor, Points& points) const;
};

class Level {
 public:
  /// Springs are `times_longer` times as long as the topology's, and equally stiff.
  Level(const Layout& layout, const GridTopology& topology, double times_longer);

  const Layout& layout() const { return layout_; }
  const Matrix<float>& matrix() const { return matrix_; }
  const Matrix<double>& exact() const { return exact_; }

  Eigen::ArrayXd inertia, free;          // per particle: N/m; 1 or 0
  AlignedBuffer<double> x;               // m, a field
  AlignedBuffer<float> b, u, change, r;  // fields: right side and solution of the V-cycle, and working memory

  void load_inertia();  // reads `inertia` and `free`
  /// Smallest share of inertia in the diagonal over all particles; 1 without springs.
  double inertia_share() const { return inertia_share_; }
  /// Computes the clamped stiffness at x, and the inverse diagonal blocks.
  void linearise(const Kernels& f);
  /// Computes the unclamped stiffness, in exact() only.
  void linearise_unclamped(const Kernels& f);

 private:
  Layout layout_;
  double stiffness_ = 0, inertia_share_ = 0;  // N/m, largest sum over a particle's springs; and a dimensionless share
  SpringGeometry geometry_{};
  AlignedBuffer<double> k_[directions], springs_[directions], inertia_, free_, blocks_, sums_, force_;
  AlignedBuffer<float> single_springs_[directions], single_inertia_, single_free_, single_blocks_, single_force_;
  double* spring_data_[directions] = {};
  Matrix<float> matrix_{};
  Matrix<double> exact_{};
};

class VCycle {
 public:
  VCycle(const GridTopology& topology, const std::vector<int>& pins);

  /// inertia: per particle, N/m; x: positions, m (3 x n).
  void set(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature);

  const Kernels& kernels() const { return kernels_; }
  const Layout& layout() const { return levels_.front().layout(); }
  const Matrix<double>& exact() const { return levels_.front().exact(); }

  /// Fields with the right side and the solution of a V-cycle.
  AlignedBuffer<float>& b() { return levels_.front().b; }
  const AlignedBuffer<float>& u() const { return levels_.front().u; }
  void cycle() { cycle(0); }
  /// Products per cycle; those on coarse grids count in proportion to their number of particles.
  double products() const;

 private:
  struct GridTransfer {
    Transfer transfer{};
    AlignedBuffer<float> right, left;
  };
  static GridTransfer grid_transfer(const Layout& fine, const Layout& coarse);
  void set_inertia(const Eigen::ArrayXd& inertia);
  void cycle(size_t level);

  Kernels kernels_;
  std::vector<Level> levels_;
  std::vector<GridTransfer> transfers_;
  Eigen::ArrayXd inertia_;  // per particle, as last set
  size_t coarsest_ = 0;     // first level on which relaxation alone suffices
};

class MultigridSolver {
 public:
  MultigridSolver(const GridTopology& topology, const std::vector<int>& pins);

  /// Solves (inertia + K(x)) u = b for u (3 x n) until |b - A u| <= tolerance |b|. `inertia` (N/m) is per particle, x
  /// (m) and b (N) are 3 x n; pins do not move. As in conjugate_gradients(), the residual is updated by recurrence, and
  /// the solve stops at a direction of negative curvature, which it returns in u. Gives up after 500 iterations, ten
  /// times as many as cloths are known to need.
  CgResult solve(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature, const Points& b, double tolerance,
                 Points& u);

  /// Matrix products per iteration, counted as in VCycle::products().
  double products() const { return 1 + v_cycle_.products(); }

 private:
  VCycle v_cycle_;
  AlignedBuffer<double> u_, r_, p_, q_;
};

/// Null unless the model is a large enough regular cloth whose stiffness comes from springs only.
std::unique_ptr<MultigridSolver> make_multigrid_solver(const Model& model);

}  // namespace crosscheck::multigrid
