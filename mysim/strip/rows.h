// Rows of blocks with copies beside them (strip/kernel.h), whatever stands in a block: `line` numbers of it. Like
// strip/lanes.h, included only where code is compiled for each instruction set.
#pragma once

#include "mysim/strip/kernel.h"
#include "mysim/strip/lanes.h"

namespace crosscheck::strip {
namespace {

template <class T>
ALWAYS void clear(T* row, long numbers) {
  for (long i = 0; i < numbers; i += Lanes<T>::width) Lanes<T>::store(row + i, Lanes<T>::all(0));
}

/// What the copies beside a row of forces were given goes to the blocks that they are copies of, a lane to the side.
/// The one lane of a copy that has no original holds 0, so that what it is added to, which lies beyond, stays as it is.
template <int line, class T>
ALWAYS void fold(T* row, int blocks) {
  using L = Lanes<T>;
  const auto give = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < line; i += L::width) L::store(to + i, L::load(to + i) + L::load(from + i));
  };
  // from the last: where there is one block, the second copy is the first one's
  for (int b = after - 1; b >= 0; --b) give(row + b * line + 1, row + (blocks + b) * line);
  give(row + (blocks - 1) * line - 1, row - line);
}

/// The copies beside a row of positions. The one lane that has no original is given some number nearby; no spring
/// reaches it.
template <int line, class T>
ALWAYS void copy_ends(T* row, int blocks) {
  using L = Lanes<T>;
  const auto copy = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < line; i += L::width) L::store(to + i, L::load(from + i));
  };
  for (int b = 0; b < after; ++b) copy(row + (blocks + b) * line, row + b * line + 1);
  copy(row - line, row + (blocks - 1) * line - 1);
}

}  // namespace
}  // namespace crosscheck::strip
