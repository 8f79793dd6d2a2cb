// What a spring costs in one step, kernel by kernel.
#pragma once

#include "experiments/bench/micro.h"
#include "experiments/table.h"

namespace crosscheck {

struct KernelsAsked {
  std::vector<int> sizes = {64, 128, 256};  // particles along a side
  MicroPlan plan;
};

/// `bench-kernels-cost`: ns of CPU time per spring and step with 90 % intervals, how many times the naive loop's speed
/// (medians over rounds of the same run), operations per second counting `flop_per_spring`, and their share of the most
/// that the same instructions do in registers. The naive loop: Eigen::Vector3d, spring by spring, forces only; the
/// general kernel: forces only; the sweep: a whole step.
Table kernels_table(const KernelsAsked& asked);

}  // namespace crosscheck
