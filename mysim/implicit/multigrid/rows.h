// Rows of a field on lanes, and the sweep that adds up what springs do to them. Like simd/lanes.h, included only where
// code is compiled for each instruction set.
#pragma once

#include "mysim/implicit/multigrid/kernels.h"
#include "mysim/simd/cloth_grid/rows.h"

namespace crosscheck::multigrid {
namespace {

using simd::clear;
using simd::fill_halo;
using simd::reduce_halo;

template <class T>
using L = simd::Lanes<T>;
template <class T>
using V = typename L<T>::V;

/// A block of so many numbers of each particle.
template <int numbers>
inline constexpr int tile_size = numbers* lanes;

FORCE_INLINE long row_length(int blocks, int numbers) {
  return static_cast<long>(left_halo + blocks + right_halo) * numbers * lanes;
}

/// The first block of a row of a field.
template <class T>
FORCE_INLINE T* row_of(T* field, int blocks, int row) {
  return field + row * row_length(blocks, 3) + left_halo * tile_size<3>;
}

/// Goes over the rows from the first: begin(row, sums) adds to sums[0] (the row itself) and to sums[1], sums[2] (the
/// next ones), finish(row, sums) is told when all that reach a row have been added. `memory`: three rows.
template <int numbers, class T, class Begin, class Finish>
FORCE_INLINE void over_rows(int rows, int blocks, T* memory, Begin begin, Finish finish) {
  const long length = row_length(blocks, numbers), first = left_halo * tile_size<numbers>;
  T* sums[3] = {memory + first, memory + length + first, memory + 2 * length + first};
  for (T* row : sums) clear(row - first, length);
  for (int r = 0; r < rows; ++r) {
    begin(r, sums);
    reduce_halo<tile_size<numbers>>(sums[0], blocks);
    finish(r, sums[0]);
    T* done = sums[0];
    clear(done - first, length);
    sums[0] = sums[1], sums[1] = sums[2], sums[2] = done;
  }
}

/// Sums lane by lane, whatever a register holds.
struct Sum {
  alignas(64) double each[lanes] = {};
  double total() const {
    double all = 0;
    for (const double one : each) all += one;
    return all;
  }
};

}  // namespace
}  // namespace crosscheck::multigrid
