// Experiment `cost`: the time of a step by size, by phase, and relative to this machine's roofline.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"

namespace crosscheck {

// Measured peaks of this machine (S. Williams, A. Waterman and D. Patterson, "Roofline", 2009).

/// A loop with a known amount of work; run() executes it once and returns its CPU time, s.
struct Kernel {
  double flop, bytes;  // per run; bytes that the source reads and writes
  std::function<double()> run;
};

/// Independent multiplications and additions in registers, fused if mysim's kernels use fused ones.
Kernel multiply_add_kernel();

/// a = b + s c over three arrays of `bytes` in total, 24 bytes per element: the bandwidth of memory of that size.
Kernel triad_kernel(double bytes);

/// `size-cost`: time per step of every method on a cloth of n x n particles.
void cost_of_size(const Request& request, int n, TableSet& tables);
/// `phases-cost`: phases of mysim's leapfrog on a cloth above a sphere. In the general engine: springs, other forces,
/// contact and the rest of the step. In the fused step, which does everything in one pass: the whole step. For Bullet's
/// worlds: the whole step, because their phases cannot be observed from outside.
void cost_of_phases(const Request& request, int n, TableSet& tables);
/// Table `phases-cost` from measured times, s. For methods[0]: springs, all forces, a step without the sphere, a step
/// with it. Then whole steps of the other methods.
Table phases_table(int n, const std::vector<std::string>& methods, const std::vector<Timing>& times);
/// `roofline-cost`: the machine's peaks and the spring kernel at several sizes.
void cost_against_roofline(bool full, TableSet& tables);
/// A remark if the measured peak is below the rate of the triad loop (both in flop/s); otherwise nothing.
std::optional<std::string> doubt_about_peak(double peak, double triad);

/// Floating-point operations of the spring kernel per spring: 3 differences, 5 for the squared length, 1 difference and
/// 1 product for the tension, 3 products, and 6 to add the force to both ends. A root and a quotient count as 7 each,
/// the number of multiplications and additions that they displace.
inline constexpr double flop_per_spring = 33;
/// Memory traffic of the kernel per spring and per particle, B. Spring: two ends (8), stiffness and rest length (16),
/// the force written once and read twice (3 x 32), the index of its second end (4). Particle: a position copied (24 +
/// 32) and read from the copy (32), a force read and written (48), two ranges (16).
inline constexpr double bytes_per_spring = 124, bytes_per_particle = 152;

}  // namespace crosscheck
