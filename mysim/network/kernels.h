// The functions of diagonals.cpp and pairs.cpp for each instruction set.
#pragma once

#include "mysim/network/diagonals.h"
#include "mysim/network/pairs.h"
#include "mysim/strip/kernels.h"
#include "mysim/terms/springs.h"

namespace crosscheck::network {

/// Both add the springs' forces at positions x (m) to f (N), both 3 x particles, and return whether some two ends met.
/// They may look at lanes without a spring, too: whether springs were among them is to be found out.
struct Functions {
  bool (*diagonals)(const Diagonals&, const double* x, double* f);
  bool (*pairs)(const Pairs&, const double* x, double* f);
};
Functions functions(strip::Isa isa, SpringLaw law);

/// What things take on this kind of instructions, ns, as measured on one machine; only their ratios matter. Both kinds
/// of AVX share one set: they sort springs alike, add them up in the same order, and so give the same bits.
struct Costs {
  double line, block;  // eight springs of a diagonal side by side; putting eight particles in and getting them out
  double pair, particle;
  double plain;  // a spring of the plain loop
  double call;
};
Costs costs(strip::Isa isa);

}  // namespace crosscheck::network
