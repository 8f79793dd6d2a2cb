// What a spring costs, kernel by kernel.
#pragma once

#include "experiments/bench/micro.h"
#include "experiments/table.h"

namespace crosscheck {

/// `bench-kernels-cost`: ns of CPU time per spring and step on a sheet with so many particles along a side, with 90 %
/// intervals; how many times the naive loop's speed, round by round; operations per second, counting `flop_per_spring`;
/// and their share of the most that the same instructions do in registers. The naive loop: Eigen::Vector3d, spring by
/// spring; it, the plain loop and the general kernel: forces only; the sweep: a whole step.
Table kernels_table(int side, const MicroPlan& plan);

}  // namespace crosscheck
