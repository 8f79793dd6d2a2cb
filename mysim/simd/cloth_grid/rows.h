// Rows of tiles with a halo (simd/cloth_grid/fused_step.h), of `tile_size` numbers per tile. Include it only in code
// that is compiled for each instruction set.
#pragma once

#include <cassert>

#include "mysim/simd/cloth_grid/fused_step.h"
#include "mysim/simd/lanes.h"

namespace crosscheck::simd {
namespace {

template <class T>
FORCE_INLINE void clear(T* row, long numbers) {
  assert(numbers % Lanes<T>::width == 0);
  for (long i = 0; i < numbers; i += Lanes<T>::width) Lanes<T>::store(row + i, Lanes<T>::all(0));
}

/// Each tile of a row's halo is a copy of another tile, shifted by one lane. Adds the forces on the halo to the
/// originals. One lane of each halo tile is a copy of nothing and holds 0; it is added to a number just outside the
/// original tile, which therefore does not change.
template <int tile_size, class T>
FORCE_INLINE void reduce_halo(T* row, int tiles) {
  assert(tiles >= 1);
  using L = Lanes<T>;
  const auto give = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < tile_size; i += L::width) L::store(to + i, L::load(to + i) + L::load(from + i));
  };
  // in reverse order, because with a single tile the second copy is a copy of the first
  for (int b = right_halo - 1; b >= 0; --b) give(row + b * tile_size + 1, row + (tiles + b) * tile_size);
  give(row + (tiles - 1) * tile_size - 1, row - tile_size);
}

/// Copies positions into a row's halo. The only lane without a source position receives a nearby number, which no
/// spring uses.
template <int tile_size, class T>
FORCE_INLINE void fill_halo(T* row, int tiles) {
  assert(tiles >= 1);
  using L = Lanes<T>;
  const auto copy = [](T * to, const T* from) __attribute__((always_inline)) {
    for (int i = 0; i < tile_size; i += L::width) L::store(to + i, L::load(from + i));
  };
  for (int b = 0; b < right_halo; ++b) copy(row + (tiles + b) * tile_size, row + b * tile_size + 1);
  copy(row - tile_size, row + (tiles - 1) * tile_size - 1);
}

}  // namespace
}  // namespace crosscheck::simd
