// Linear systems of implicit steps on a cloth: A u = b with A = inertia + stiffness of the springs, never assembled.
//
// Conjugate gradients need many iterations when springs are stiff for the step size: a pull travels by one spring per
// iteration. On a grid of every second row and column it travels twice as fast, and on a grid of every fourth row and
// column, four times as fast. The error that remains on the finest grid consists of short waves, which a few rounds of
// relaxation remove. The preconditioner is therefore one V-cycle over such grids (W. Hackbusch, Multi-Grid Methods and
// Applications, Springer 1985). A coarse grid carries the total mass, and has springs of the same stiffness and twice
// the length, because the elastic energy of an area does not depend on the grid. The preconditioner need not be exact.
// It works in single precision, with half the memory, and the outer iteration, in double precision, corrects its
// result.
//
// The relaxation is Chebyshev's, with the inverse 3 x 3 diagonal blocks. The eigenvalues of D^-1 A are below 2 for any
// springs: the springs' part of u.A u is the sum of (u_a - u_b).K (u_a - u_b) <= 2 (u_a.K u_a + u_b.K u_b), and the sum
// of these right-hand sides is twice the springs' part of u.D u.
//
// The memory layout is that of the fused step (simd/cloth_grid/fused_step.h), with as many lanes for double as for
// single precision, so that both use the same order: column c is in lane c / tiles of tile c % tiles. The coarse
// columns are the even tiles, so transfers between grids move no data across lanes. Each product is one pass over the
// rows: as soon as a row's own springs have been evaluated, the forces on it are complete, and the row can be modified
// in place.
#pragma once

#include "mysim/simd/cloth_grid/fused_step.h"

namespace crosscheck::multigrid {

using simd::Direction;
using simd::direction;
using simd::directions;
using simd::left_halo;
using simd::right_halo;

inline constexpr int lanes = 16;

/// A grid's matrix. A field holds three numbers per particle: rows x (left_halo + tiles + right_halo) x 3 x lanes, with
/// the halo filled where springs reach into it.
template <class T>
struct Matrix {
  int rows, tiles;
  const T*
      springs[directions];  // null, or rows x tiles x 4 x lanes: sqrt(k - a) n, and a: K = a I + (k - a) n n^T, N/m
  const T* inertia;         // N/m: rows x tiles x lanes
  const T* inverse;         // m/N: rows x tiles x 6 x lanes: xx yy zz xy xz yz of the inverse diagonal blocks
  const T* free;            // 1, or 0 at pins and in empty lanes: rows x tiles x lanes
  T* force;                 // N: three rows of a field, working memory
};

/// Input of linearise().
struct SpringGeometry {
  int rows, tiles;
  double* x;                    // m: a field; linearise() fills its halo
  const double* k[directions];  // N/m: null, or tiles x lanes; 0 where there is no spring
  double rest[directions];      // m
  bool clamped;                 // omit the negative part of a
  double* sums;                 // three rows of 6 numbers, working memory
};

/// The transfer between grids. A fine particle between two coarse ones interpolates them with weights 1/2; beyond the
/// last coarse particle it has the value of that particle.
struct Transfer {
  int coarse_rows, coarse_tiles, fine_rows;
  // coarse tiles x lanes: weights of this coarse particle for the fine particle to its right (1/2 or 1) and to its left
  // (1/2, or 0 if there is none)
  const float *right, *left;
};

/// The functions of one instruction set. Sums are formed lane by lane and then in a fixed order, the same for all sets.
struct Kernels {
  /// Writes `springs` (as in Matrix), and the sums of their blocks over both ends (rows x tiles x 6 x lanes).
  void (*linearise)(const SpringGeometry&, double* const* springs, double* blocks);
  /// Inverts blocks + inertia in place; 0 where not free.
  void (*invert)(double* blocks, const double* inertia, const double* free, long count);
  void (*to_float)(const double* from, float* to, long count);

  /// q = A p; returns p . q.
  double (*product)(const Matrix<double>&, const double* p, double* q);
  /// u += `length` p, r -= `length` q, copies r to single precision; returns r . r.
  double (*update_solution)(const Matrix<double>&, double length, const double* p, const double* q, double* u,
                            double* r, float* single);
  /// sums = {r . z, q . z}.
  void (*dot_products)(const Matrix<double>&, const double* r, const double* q, const float* z, double* sums);
  /// p = z + `keep` p, including the halo.
  void (*update_direction)(const Matrix<double>&, const float* z, double keep, double* p);

  /// `change` = `keep` `change` + `take` D^-1 (b - A x), x += `change`. If `first`, x and `change` start from 0.
  void (*smooth)(const Matrix<float>&, bool first, float keep, float take, const float* b, float* x, float* change);
  /// r = b - A x, including the halo.
  void (*residual)(const Matrix<float>&, const float* b, const float* x, float* r);
  void (*restrict_residual)(const Transfer&, const float* r, float* b);
  /// x += the interpolated coarse solution, including the halo.
  void (*prolong_and_add)(const Transfer&, const float* coarse, const float* free, float* x);
};

}  // namespace crosscheck::multigrid
