// Effective stiffness of hanging nets under position-based methods, depending on the step and the number of iterations.
#pragma once

#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

/// One point per net.
std::vector<Point> effective_stiffness_points(bool full);

}  // namespace crosscheck
