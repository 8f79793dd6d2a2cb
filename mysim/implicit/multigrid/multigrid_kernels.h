// Linear systems of implicit steps on a cloth: A u = b with A = inertia + stiffness of the springs, never formed.
//
// Conjugate gradients need many iterations where springs are stiff for the step: a pull at one end moves through the
// cloth by one spring in each iteration. On a grid of every second row and column it moves twice as fast, on one of
// every fourth four times; and the error left on the finest grid is short waves, which a few rounds of relaxation
// remove. So one V-cycle over such grids is the preconditioner. A coarse grid has springs of the same stiffness, twice
// as long (elastic energy of an area does not depend on the grid), along its own particles' differences, and the mass
// of all: W. Hackbusch, Multi-Grid Methods and Applications, Springer 1985. A preconditioner need only be roughly
// right: it works in single precision, at half the memory, while the outer iteration is in double and corrects it.
//
// Relaxation is Chebyshev's with the inverse 3 x 3 blocks on the diagonal. Its eigenvalues are below 2 for any springs:
// u.A u sums (u_a - u_b).K (u_a - u_b) <= 2 (u_a.K u_a + u_b.K u_b) over springs, and that is twice the blocks' sum.
//
// Memory is that of the fused step (simd/cloth_grid/fused_step.h), with as many lanes for double as for single
// precision, so that both stand in the same order: column c in lane c / tiles of tile c % tiles. Coarse columns are
// then the tiles of even number, lane by lane, and nothing is moved across lanes between grids. Each product is one
// pass over the rows: forces of a row are complete once its own springs are taken, and then the row may be changed in
// place.
#pragma once

#include "mysim/simd/cloth_grid/fused_step.h"

namespace crosscheck::multigrid {

using simd::Direction;
using simd::direction;
using simd::directions;
using simd::left_halo;
using simd::right_halo;

inline constexpr int lanes = 16;

/// A grid, and the part of its matrix that depends on positions. Three numbers of each particle are a field: rows x
/// (left_halo + tiles + right_halo) x 3 x lanes, with the halo filled where springs reach into it.
template <class T>
struct Matrix {
  int rows, tiles;
  const T*
      springs[directions];  // null, or rows x tiles x 4 x lanes: sqrt(k - a) n, and a: K = a I + (k - a) n n^T, N/m
  const T* inertia;         // N/m: rows x tiles x lanes
  const T* inverse;         // m/N: rows x tiles x 6 x lanes: xx yy zz xy xz yz of the inverse blocks on the diagonal
  const T* free;            // 1, or 0 at pins and where there is no particle: rows x tiles x lanes
  T* force;                 // N: three rows of a field, working memory
};

/// The source of the springs' stiffness.
struct SpringGeometry {
  int rows, tiles;
  double* x;                    // m: a field; its halo is filled
  const double* k[directions];  // N/m: null, or tiles x lanes; 0 where there is no spring
  double rest[directions];      // m
  bool clamped;                 // without the negative part of a
  double* sums;                 // three rows of 6 numbers, working memory
};

/// The transfer between a coarse grid and a fine one: a fine particle between two coarse ones takes half of each;
/// beyond the last coarse one, all of it.
struct Transfer {
  int coarse_rows, coarse_tiles, fine_rows;
  // coarse tiles x lanes: what the fine particle to the right takes of this coarse one, 1/2 or 1; and the one to the
  // left, 1/2, or 0 where there is none
  const float *right, *left;
};

/// The functions of one instruction set. Sums are taken lane by lane and then in one order, the same on all.
struct Kernels {
  /// Springs into `springs` (as in Matrix), the sums of their blocks over both ends into `blocks` (rows x tiles x 6 x
  /// lanes).
  void (*linearise)(const SpringGeometry&, double* const* springs, double* blocks);
  /// The inverse of blocks + inertia, in place; 0 where not free.
  void (*invert)(double* blocks, const double* inertia, const double* free, long count);
  void (*to_float)(const double* from, float* to, long count);

  /// q = A p; returns p . q.
  double (*product)(const Matrix<double>&, const double* p, double* q);
  /// u += length p, r -= length q, and r again in single precision; returns r . r.
  double (*update_solution)(const Matrix<double>&, double length, const double* p, const double* q, double* u,
                            double* r, float* single);
  /// r . z and q . z.
  void (*dot_products)(const Matrix<double>&, const double* r, const double* q, const float* z, double* sums);
  /// p = z + keep p, with its halo.
  void (*update_direction)(const Matrix<double>&, const float* z, double keep, double* p);

  /// change = keep change + take D^-1 (b - A x), x += change. `first`: x and change are 0 before.
  void (*smooth)(const Matrix<float>&, bool first, float keep, float take, const float* b, float* x, float* change);
  /// r = b - A x, with its halo.
  void (*residual)(const Matrix<float>&, const float* b, const float* x, float* r);
  void (*restrict_residual)(const Transfer&, const float* r, float* b);
  /// x += the coarse solution, interpolated, with its halo.
  void (*prolong_and_add)(const Transfer&, const float* coarse, const float* free, float* x);
};

}  // namespace crosscheck::multigrid
