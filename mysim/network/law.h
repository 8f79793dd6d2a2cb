// The two laws of springs on lanes. Like strip/lanes.h, included only where code is compiled for each instruction set.
#pragma once

#include "mysim/strip/lanes.h"

namespace crosscheck::network {
namespace {

using L = strip::Lanes<double>;
using V = L::V;

/// m^2: nothing that is not 0 comes so close.
inline constexpr double smallest = 1e-290;

/// Force over difference of the ends, N/m, at squared length s, m^2: -T / L. Hooke's is k (r / L - 1), where r / L is
/// wrong by 3 units in the last place and the subtraction is fused: near the rest length the force, k L times that, is
/// wrong by 3 eps k r, as that of the plain loop is by the rounding of its length. Ends that met: a large number times
/// a difference of 0.
template <bool hooke>
ALWAYS V scale_of(V s, V k, V rest) {
  s = L::max(s, L::all(smallest));
  if constexpr (hooke) return k * L::fma(rest, strip::inverse_root<double, false>(s), L::all(-1));
  const V r2 = rest * rest;
  return k * (r2 - s) / (s + r2);
}

}  // namespace
}  // namespace crosscheck::network
