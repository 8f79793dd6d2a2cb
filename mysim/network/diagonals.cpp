// See diagonals.h. Compiled once for each instruction set, CROSSCHECK_ISA naming it.
#include "mysim/network/diagonals.h"

#include "mysim/network/law.h"

namespace crosscheck::network {
namespace {

/// Registers that walk a block together: they share the counting.
inline constexpr int abreast = L::width == block ? 1 : 2;
inline constexpr int stretch = abreast * L::width;

/// Three coordinates of the particles in `abreast` registers.
struct Sums {
  V f[3][abreast];
};

ALWAYS long ring_length(const Diagonal& diagonal) { return diagonal.mask + 1 + block; }
ALWAYS long place(int b) { return static_cast<long>(b) * block; }

/// The springs that begin in a stretch of a block.
template <bool hooke>
ALWAYS Sums begin_at(const Diagonals& s, int b, int lane, const int* line, V& least) {
  const long at = place(b) + lane;
  const double *const x[3] = {s.x[0] + at, s.x[1] + at, s.x[2] + at}, *const lines = s.lines + lane;
  V near[3][abreast];
  Sums sum;
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < abreast; ++a) near[c][a] = L::load(x[c] + a * L::width), sum.f[c][a] = L::all(0);
  for (const Diagonal *diagonal = s.diagonals, *last = diagonal + s.count; diagonal < last; ++diagonal) {
    if (b < diagonal->first || b >= diagonal->last) continue;
    const double* own = lines + 2L * block * *line++;
    const long n = ring_length(*diagonal), r = at & diagonal->mask;
    for (int a = 0; a < abreast; ++a, own += L::width) {
      V d[3];
      for (int c = 0; c < 3; ++c) d[c] = near[c][a] - L::load(x[c] + a * L::width + diagonal->offset);
      const V squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      least = L::min(least, squared);
      const V scale = scale_of<hooke>(squared, L::load(own), L::load(own + block));
      double* to = diagonal->ring + r + a * L::width;
      for (int c = 0; c < 3; ++c) {
        d[c] = scale * d[c];  // now the force
        sum.f[c][a] = sum.f[c][a] + d[c];
        L::store(to + c * n, d[c]);
      }
      if (r < block)
        for (int c = 0; c < 3; ++c) L::store(to + c * n + diagonal->mask + 1, d[c]);
    }
  }
  return sum;
}

template <bool hooke>
ALWAYS void begin_block(const Diagonals& s, int b, const int*& line, V& least) {
  for (int lane = 0; lane < block; lane += stretch) {
    const Sums sum = begin_at<hooke>(s, b, lane, line, least);
    double* to = s.pulls + (b & 1) * 3 * block + lane;
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < abreast; ++a) L::store(to + c * block + a * L::width, sum.f[c][a]);
  }
  for (int i = 0; i < s.count; ++i) line += b >= s.diagonals[i].first && b < s.diagonals[i].last;
}

/// What all springs do to a block, onto f.
ALWAYS void finish_block(const Diagonals& s, int b, double* f) {
  alignas(64) double last[3 * block];  // of the last block, which may hold fewer particles
  const int there = s.particles - b * block;
  double* to = f + 3 * place(b);
  if (there < block) {
    for (int i = 0; i < 3 * block; i += L::width) L::store(last + i, L::all(0));
    for (int i = 0; i < 3 * there; ++i) last[i] = to[i];
  }
  double* onto = there < block ? last : to;
  for (int lane = 0; lane < block; lane += stretch) {
    Sums sum;
    const double* pulls = s.pulls + (b & 1) * 3 * block + lane;
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < abreast; ++a) sum.f[c][a] = L::load(pulls + c * block + a * L::width);
    for (int i = 0; i < s.count; ++i) {
      const Diagonal& diagonal = s.diagonals[i];
      const long from = place(b) - diagonal.offset;
      if (from + block <= place(diagonal.first) || from >= place(diagonal.last)) continue;
      const long n = ring_length(diagonal);
      // a block at most goes beyond the end of the ring, where it begins again
      const double* pushes = diagonal.ring + (from & diagonal.mask) + lane;
      for (int c = 0; c < 3; ++c)
        for (int a = 0; a < abreast; ++a) sum.f[c][a] = sum.f[c][a] - L::load(pushes + c * n + a * L::width);
    }
    for (int a = 0; a < abreast; ++a)
      L::add_points(onto + 3 * (lane + a * L::width), sum.f[0][a], sum.f[1][a], sum.f[2][a]);
  }
  if (there < block)
    for (int i = 0; i < 3 * there; ++i) to[i] = last[i];
}

/// No forces in a block of a ring: before the first springs and after the last ones.
ALWAYS void clear(const Diagonal& diagonal, int b) {
  const long r = place(b) & diagonal.mask;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < block; ++i) {
      double* ring = diagonal.ring + c * ring_length(diagonal) + i;
      ring[r] = 0;
      if (r == 0) ring[diagonal.mask + 1] = 0;
    }
}

ALWAYS void put(const Diagonals& s, const double* x) {
  for (int i = 0; i < s.particles; ++i)
    for (int c = 0; c < 3; ++c) s.x[c][i] = x[3L * i + c];
}

template <bool hooke>
bool diagonals(const Diagonals& s, const double* x, double* f) {
  put(s, x);
  for (int i = 0; i < s.count; ++i) clear(s.diagonals[i], s.diagonals[i].first - 1);
  const int* line = s.line;
  V least = L::all(1);
  for (int b = 0; b < s.blocks; ++b) {
    for (int i = 0; i < s.count; ++i)
      if (s.diagonals[i].last == b) clear(s.diagonals[i], b);
    begin_block<hooke>(s, b, line, least);
    if (b > 0) finish_block(s, b - 1, f);
  }
  finish_block(s, s.blocks - 1, f);
  return L::any_below(least, L::all(smallest));
}

}  // namespace

namespace CROSSCHECK_ISA {

bool hooke_diagonals(const Diagonals& s, const double* x, double* f) { return diagonals<true>(s, x, f); }
bool link_diagonals(const Diagonals& s, const double* x, double* f) { return diagonals<false>(s, x, f); }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::network
