// Experiment `cost`: the time of a step as a function of size, by phase, and relative to this machine's roofline.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"

namespace crosscheck {

// Measured peak rates of this machine (S. Williams, A. Waterman and D. Patterson, "Roofline", 2009).

/// A loop with a known amount of work; run() executes it once and returns its CPU time, s.
struct Kernel {
  double flop, bytes;  // per run; `bytes`: read and written according to the source
  std::function<double()> run;
};

/// Independent multiplications and additions in registers, as fused operations if mysim's kernels use these.
Kernel multiply_add_kernel();

/// a = b + s c over three arrays of `bytes` bytes in total, 24 per element. Measures the bandwidth of the memory (or
/// cache) that holds arrays of this size.
Kernel triad_kernel(double bytes);

/// `size-cost`: time per step of every method on a cloth of n x n particles.
void cost_of_size(const Request& request, int n, TableSet& tables);
/// `phases-cost`: phases of a step on a cloth above a sphere. For mysim's leapfrog in the general engine: springs,
/// other forces, contact and the rest of the step. For its fused step (a single pass) and Bullet's worlds (whose phases
/// cannot be observed): the whole step.
void cost_of_phases(const Request& request, int n, TableSet& tables);
/// Table `phases-cost` from measured times (s). For methods[0], these are the times of the springs, of all forces, of a
/// step without the sphere and of a step with it. The times of whole steps of the other methods follow.
Table phases_table(int n, const std::vector<std::string>& methods, const std::vector<Timing>& times);
/// `roofline-cost`: the machine's peaks and the spring kernel at several sizes.
void cost_against_roofline(bool full, TableSet& tables);
/// A remark if the measured peak is below the rate of the triad loop (both in flop/s); otherwise nullopt.
std::optional<std::string> doubt_about_peak(double peak, double triad);

/// Floating-point operations of the spring kernel per spring: 3 differences, 5 for the squared length, 1 difference and
/// 1 product for the tension, 3 products, and 6 to add the force to both ends. A root and a quotient count as 7
/// operations each, the number of multiplications and additions that they displace.
inline constexpr double flop_per_spring = 33;
/// Memory traffic of the kernel per spring and per particle, B. Spring: its two ends (8), stiffness and rest length
/// (16), the force, which is written once and read twice (3 x 32), and the index of the second end (4). Particle: the
/// position, which is copied (24 + 32) and read from the copy (32), the force, which is read and written (48), and two
/// ranges (16).
inline constexpr double bytes_per_spring = 124, bytes_per_particle = 152;

}  // namespace crosscheck
