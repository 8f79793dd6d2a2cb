// What this machine can do at most, measured by small loops of this build (S. Williams, A. Waterman and D. Patterson,
// "Roofline", 2009).
#pragma once

#include <functional>

namespace crosscheck {

/// A loop with a known amount of work; run() does it once and says what CPU time it took, s.
struct Kernel {
  double flop, bytes;  // of one run; bytes as the source asks for them
  std::function<double()> run;
};

/// Multiplications and additions in registers that wait for nobody, with the instructions that mysim's kernels use
/// (fused ones where these have them).
Kernel multiply_add_kernel();

/// a = b + s c over three arrays of `bytes` in all: what memory of that size delivers. 24 bytes an element.
Kernel triad_kernel(double bytes);

}  // namespace crosscheck
