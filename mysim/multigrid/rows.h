// Rows of a field on lanes, and the sweep that adds up what springs do to them. Like strip/lanes.h, included only where
// code is compiled for each instruction set.
#pragma once

#include "mysim/multigrid/kernel.h"
#include "mysim/strip/lanes.h"

namespace crosscheck::multigrid {
namespace {

template <class T>
using L = strip::Lanes<T>;
template <class T>
using V = typename L<T>::V;

/// A block of so many numbers of each particle.
template <int numbers>
inline constexpr int line = numbers* lanes;

ALWAYS long row_length(int blocks, int numbers) { return static_cast<long>(before + blocks + after) * numbers * lanes; }

/// The first block of a row of a field.
template <class T>
ALWAYS T* row_of(T* field, int blocks, int row) {
  return field + row * row_length(blocks, 3) + before * line<3>;
}

template <class T>
ALWAYS void clear(T* from, long count) {
  for (long i = 0; i < count; i += L<T>::width) L<T>::store(from + i, L<T>::all(0));
}

/// The copies beside a row. The lanes that have no original are given some number nearby; no spring reaches them.
template <class T>
ALWAYS void copy_ends(T* row, int blocks) {
  const auto copy = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < line<3>; i += L<T>::width) L<T>::store(to + i, L<T>::load(from + i));
  };
  // in this order: where there is one block, the second copy is the first one's
  for (int b = 0; b < after; ++b) copy(row + (blocks + b) * line<3>, row + b * line<3> + 1);
  copy(row - line<3>, row + (blocks - 1) * line<3> - 1);
}

/// What the copies were given goes to the blocks that they are copies of, a lane to the side. Lanes of a copy that have
/// no original hold 0.
template <class T, int numbers>
ALWAYS void fold(T* row, int blocks) {
  const auto give = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < line<numbers>; i += L<T>::width) L<T>::store(to + i, L<T>::load(to + i) + L<T>::load(from + i));
  };
  for (int b = after - 1; b >= 0; --b) give(row + b * line<numbers> + 1, row + (blocks + b) * line<numbers>);
  give(row + (blocks - 1) * line<numbers> - 1, row - line<numbers>);
}

/// Goes over the rows from the first: begin(row, sums) adds to sums[0] (the row itself) and to sums[1], sums[2] (the
/// next ones), finish(row, sums) is told when all that reach a row have been added. `memory`: three rows.
template <int numbers, class T, class Begin, class Finish>
ALWAYS void over_rows(int rows, int blocks, T* memory, Begin begin, Finish finish) {
  const long length = row_length(blocks, numbers), first = before * line<numbers>;
  T* sums[3] = {memory + first, memory + length + first, memory + 2 * length + first};
  for (T* row : sums) clear(row - first, length);
  for (int r = 0; r < rows; ++r) {
    begin(r, sums);
    fold<T, numbers>(sums[0], blocks);
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
