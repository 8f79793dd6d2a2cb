// Compiled once per instruction set.
#include "mysim/simd/spring_graph/dia_coo_kernels.h"

#include <cassert>

#include "mysim/simd/lanes.h"

namespace crosscheck::spring_graph {
namespace {

using L = simd::Lanes<double>;
using V = L::V;

/// m^2; below any nonzero squared length.
inline constexpr double min_squared_length = 1e-290;

/// -T / L (N/m) at squared length s (m^2). For coincident ends it is a large number, which is multiplied by a
/// difference of 0. Square root and division are the machine's, correctly rounded, and nothing is fused, so that each
/// spring's force equals that of the plain loop to the last bit, on all instruction sets. This matters most near the
/// rest length, where r - L is a small difference of large numbers: springs at rest must exert no force. An estimate of
/// 1 / L with Newton steps (as in simd/lanes.h) does not pay: correct rounding of the length takes a third longer than
/// square root and division, which overlap with other work.
template <bool hooke>
FORCE_INLINE V scale_of(V s, V k, V rest) {
  s = L::max(s, L::all(min_squared_length));
  if constexpr (hooke) {
    const V length = L::root(s);
    return k * (rest - length) / length;
  }
  const V r2 = rest * rest;
  return k * (r2 - s) / (s + r2);
}

/// Registers that process a tile together, to share the loop overhead.
inline constexpr int registers_per_group = L::width == tile ? 1 : 2;
inline constexpr int group_size = registers_per_group * L::width;

struct Sums {
  V f[3][registers_per_group];
};

FORCE_INLINE long ring_length(const Diagonal& diagonal) { return diagonal.mask + 1 + tile; }
FORCE_INLINE long place(int b) { return static_cast<long>(b) * tile; }

/// Springs that begin in one group of a tile.
template <bool hooke>
FORCE_INLINE Sums begin_at(const DiaSprings& s, int b, int lane, const int* coefficient_row, V& least) {
  const long at = place(b) + lane;
  const double *const x[3] = {s.x[0] + at, s.x[1] + at, s.x[2] + at}, *const coefficients = s.coefficients + lane;
  V near[3][registers_per_group];
  Sums sum;
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < registers_per_group; ++a) near[c][a] = L::load(x[c] + a * L::width), sum.f[c][a] = L::all(0);
  for (const Diagonal *diagonal = s.diagonals, *last = diagonal + s.count; diagonal < last; ++diagonal) {
    if (b < diagonal->first || b >= diagonal->last) continue;
    const double* own = coefficients + 2L * tile * *coefficient_row++;
    const long n = ring_length(*diagonal), r = at & diagonal->mask;
    for (int a = 0; a < registers_per_group; ++a, own += L::width) {
      V d[3];
      for (int c = 0; c < 3; ++c) d[c] = near[c][a] - L::load(x[c] + a * L::width + diagonal->offset);
      const V squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      least = L::min(least, squared);
      const V scale = scale_of<hooke>(squared, L::load(own), L::load(own + tile));
      double* to = diagonal->ring + r + a * L::width;
      for (int c = 0; c < 3; ++c) {
        d[c] = scale * d[c];  // becomes the force
        sum.f[c][a] = sum.f[c][a] + d[c];
        L::store(to + c * n, d[c]);
      }
      if (r < tile)
        for (int c = 0; c < 3; ++c) L::store(to + c * n + diagonal->mask + 1, d[c]);
    }
  }
  return sum;
}

template <bool hooke>
FORCE_INLINE void begin_tile(const DiaSprings& s, int b, const int*& coefficient_row, V& least) {
  for (int lane = 0; lane < tile; lane += group_size) {
    const Sums sum = begin_at<hooke>(s, b, lane, coefficient_row, least);
    double* to = s.pulls + (b & 1) * 3 * tile + lane;
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < registers_per_group; ++a) L::store(to + c * tile + a * L::width, sum.f[c][a]);
  }
  for (int i = 0; i < s.count; ++i) coefficient_row += b >= s.diagonals[i].first && b < s.diagonals[i].last;
}

FORCE_INLINE void finish_tile(const DiaSprings& s, int b, double* f) {
  alignas(64) double last[3 * tile];  // the last tile may hold fewer particles
  const int there = s.particles - b * tile;
  double* to = f + 3 * place(b);
  if (there < tile) {
    for (int i = 0; i < 3 * tile; i += L::width) L::store(last + i, L::all(0));
    for (int i = 0; i < 3 * there; ++i) last[i] = to[i];
  }
  double* onto = there < tile ? last : to;
  for (int lane = 0; lane < tile; lane += group_size) {
    Sums sum;
    const double* pulls = s.pulls + (b & 1) * 3 * tile + lane;
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < registers_per_group; ++a) sum.f[c][a] = L::load(pulls + c * tile + a * L::width);
    for (int i = 0; i < s.count; ++i) {
      const Diagonal& diagonal = s.diagonals[i];
      const long from = place(b) - diagonal.offset;
      if (from + tile <= place(diagonal.first) || from >= place(diagonal.last)) continue;
      const long n = ring_length(diagonal);
      // at most one tile extends beyond the ring, where the first tile is repeated
      const double* pushes = diagonal.ring + (from & diagonal.mask) + lane;
      for (int c = 0; c < 3; ++c)
        for (int a = 0; a < registers_per_group; ++a)
          sum.f[c][a] = sum.f[c][a] - L::load(pushes + c * n + a * L::width);
    }
    for (int a = 0; a < registers_per_group; ++a)
      L::add_points(onto + 3 * (lane + a * L::width), sum.f[0][a], sum.f[1][a], sum.f[2][a]);
  }
  if (there < tile)
    for (int i = 0; i < 3 * there; ++i) to[i] = last[i];
}

/// Clears a tile of a ring: before the first springs and after the last ones.
FORCE_INLINE void clear(const Diagonal& diagonal, int b) {
  const long r = place(b) & diagonal.mask;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < tile; ++i) {
      double* ring = diagonal.ring + c * ring_length(diagonal) + i;
      ring[r] = 0;
      if (r == 0) ring[diagonal.mask + 1] = 0;
    }
}

FORCE_INLINE void load_positions(const DiaSprings& s, const double* x) {
  for (int i = 0; i < s.particles; ++i)
    for (int c = 0; c < 3; ++c) s.x[c][i] = x[3L * i + c];
}

template <bool hooke>
bool add_dia_forces(const DiaSprings& s, const double* x, double* f) {
  for (int i = 0; i < s.count; ++i) {
    [[maybe_unused]] const Diagonal& diagonal = s.diagonals[i];
    assert((diagonal.mask & (diagonal.mask + 1)) == 0 && diagonal.mask + 1 >= diagonal.offset + 3 * tile);
    assert(diagonal.offset > 0 && 0 <= diagonal.first && diagonal.first < diagonal.last && diagonal.last <= s.tiles);
  }
  load_positions(s, x);
  for (int i = 0; i < s.count; ++i) clear(s.diagonals[i], s.diagonals[i].first - 1);
  const int* coefficient_row = s.coefficient_row;
  V least = L::all(1);
  for (int b = 0; b < s.tiles; ++b) {
    for (int i = 0; i < s.count; ++i)
      if (s.diagonals[i].last == b) clear(s.diagonals[i], b);
    begin_tile<hooke>(s, b, coefficient_row, least);
    if (b > 0) finish_tile(s, b - 1, f);
  }
  finish_tile(s, s.tiles - 1, f);
  return L::any_less(least, L::all(min_squared_length));
}

FORCE_INLINE void load_positions(const CooSprings& s, const double* x) {
  for (int i = 0; i < s.particles; ++i)
    for (int c = 0; c < 3; ++c) s.x[4L * i + c] = x[3L * i + c];
  for (long i = 0; i < 4L * s.particles; i += 4) L::store_record(s.force + i, L::Record{});
}

template <bool hooke>
bool add_coo_forces(const CooSprings& s, const double* x, double* f) {
  assert(s.springs % tile == 0);
  load_positions(s, x);
  V least = L::all(1);
  for (int i = 0; i < s.springs; i += L::width) {
    const int* ends = s.ends + 2L * i;
    const L::Records d = L::difference(s.x, ends);
    const V squared = L::squared_norms(d);
    least = L::min(least, squared);
    const V scale = scale_of<hooke>(squared, L::load(s.k + i), L::load(s.rest + i));
    L::each_scaled(
        d, scale, [&](int spring, L::Record pull) __attribute__((always_inline)) {
          double *a = s.force + ends[2 * spring], *b = s.force + ends[2 * spring + 1];
          L::store_record(a, L::record(a) + pull);
          L::store_record(b, L::record(b) - pull);
        });
  }
  for (int i = 0; i < s.particles; ++i) L::add_point(f + 3L * i, L::record(s.force + 4L * i));
  return L::any_less(least, L::all(min_squared_length));
}

}  // namespace

namespace CROSSCHECK_ISA {

Kernels kernels_of(bool hooke) {
  if (hooke) return {add_dia_forces<true>, add_coo_forces<true>};
  return {add_dia_forces<false>, add_coo_forces<false>};
}

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::spring_graph
