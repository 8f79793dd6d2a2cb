// Experiment `cost`: what a step costs, against size, by phase, and on the roofline of this machine.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"

namespace crosscheck {

// The peaks of this machine, measured by small loops of this build (S. Williams, A. Waterman and D. Patterson,
// "Roofline", 2009).

/// A loop with a known amount of work; run() does it once and says what CPU time it took, s.
struct Kernel {
  double flop, bytes;  // of one run; bytes that the source reads and writes
  std::function<double()> run;
};

/// Multiplications and additions in registers that depend on no other result, with the instructions that mysim's
/// kernels use (fused ones where these have them).
Kernel multiply_add_kernel();

/// a = b + s c over three arrays of `bytes` in all: the bandwidth of memory of that size. 24 bytes an element.
Kernel triad_kernel(double bytes);

/// `size-cost`: time per step of every method on a cloth of n x n particles.
void cost_of_size(const Request& request, int n, TableSet& tables);
/// `phases-cost`: of mysim's leapfrog on a cloth above a sphere, in the general engine, what springs, other forces,
/// contact and the rest of the step take, and the whole step in the fused step, which does all of it in one pass; of
/// Bullet's worlds the whole step, since their phases cannot be seen from outside.
void cost_of_phases(const Request& request, int n, TableSet& tables);
/// The same from measured times, s: springs, all forces, a step without the sphere and a step with it (of methods[0]);
/// then whole steps, of methods[1] and on.
Table phases_table(int n, const std::vector<std::string>& methods, const std::vector<Timing>& times);
/// `roofline-cost`: the machine's peaks and the spring kernel at several sizes.
void cost_against_roofline(bool full, TableSet& tables);
/// The remark on a measured peak below the rate of another loop, flop/s; nothing where there is none.
std::optional<std::string> doubt_about_peak(double peak, double triad);

/// Work of the spring kernel per spring, in floating-point operations: 3 differences, 5 for the squared length, 1
/// difference and 1 product for the tension, 3 products, 6 to add the force to both ends; a root and a quotient count
/// as 7 each, as the multiplications and additions that they take the place of.
inline constexpr double flop_per_spring = 33;
/// Bytes that it moves for one spring, and for one particle: two ends (8), stiffness and rest length (16), the force
/// written once and read twice (3 x 32), the index of its second end (4); a position copied (24 + 32) and read from
/// there (32), a force read and written (48), two ranges (16).
inline constexpr double bytes_per_spring = 124, bytes_per_particle = 152;

}  // namespace crosscheck
