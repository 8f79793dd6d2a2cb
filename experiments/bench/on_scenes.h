// What the forces of a scene's springs cost, scene by scene.
#pragma once

#include "experiments/bench/micro.h"
#include "experiments/table.h"

namespace crosscheck {

/// `bench-scenes-cost`: on each scene (those without springs are left out) one evaluation of the springs' forces in the
/// engine's own ways (the general kernel; the sweep, a whole step, where the springs are a grid) beside the naive loop
/// of pieces.h, round by round.
Table scenes_table(const std::vector<Scene>& scenes, const MicroPlan& plan);

}  // namespace crosscheck
