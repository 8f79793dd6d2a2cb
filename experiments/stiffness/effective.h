// How stiff hanging nets are under position-based methods, over step and iterations.
#pragma once

#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

/// Of experiment `stiffness`: one point for each net.
std::vector<Point> effective_stiffness_points(bool full);

}  // namespace crosscheck
