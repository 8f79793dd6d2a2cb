// The two laws of springs on lanes. Like simd/lanes.h, included only where code is compiled for each instruction set.
#pragma once

#include "mysim/simd/lanes.h"

namespace crosscheck::spring_graph {
namespace {

using L = simd::Lanes<double>;
using V = L::V;

/// m^2: nothing that is not 0 comes so close.
inline constexpr double min_squared_length = 1e-290;

/// Force over difference of the ends, N/m, at squared length s, m^2: -T / L. Ends that met: a large number times a
/// difference of 0.
///
/// Root and quotient are the machine's, correctly rounded, and nothing is fused, so that each spring's force is the
/// same to the last bit as in the plain loop, on all instructions. Near the rest length, where r - L is a small
/// difference of large numbers, that matters most: springs at rest pull at nothing. An estimate of 1 / L with steps of
/// Newton's (as in simd/lanes.h) does not pay: once its length is corrected to be rounded rightly, it takes a third
/// longer than these two, which go on beside other work.
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

}  // namespace
}  // namespace crosscheck::spring_graph
