// The cost of a spring, kernel by kernel, on generated cloths and on shipped scenes.
#pragma once

#include "experiments/bench/microbenchmarks.h"
#include "experiments/tables/table.h"

namespace crosscheck {

/// `bench-kernels-cost`: ns of CPU time per spring and step on a cloth with so many particles along a side, with 90 %
/// intervals; how many times the naive loop's speed, round by round; operations per second, counting `flop_per_spring`;
/// and their share of the most that the same instructions do in registers. The naive loop: Eigen::Vector3d, spring by
/// spring; it, the plain loop and the general kernel: forces only; the fused step: a whole step.
Table kernels_table(int side, const MicrobenchmarkOptions& options, const LockPatience& patience);

// The cost of the spring forces, scene by scene.

/// `bench-scenes-cost`: on each scene (those without springs are left out) one evaluation of the springs' forces in the
/// engine's own kernels (the general one; the fused step, a whole step, where the springs are a grid) beside the naive
/// loop of spring_forces.h, round by round.
Table scenes_table(const std::vector<Scene>& scenes, const MicrobenchmarkOptions& options,
                   const LockPatience& patience);

}  // namespace crosscheck
