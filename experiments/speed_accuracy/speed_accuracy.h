// Experiment `speed-accuracy`: error against cost of every method on a scene, at many steps or tolerances.
#pragma once

#include "experiments/experiment.h"

namespace crosscheck {

/// Distance of two runs over the samples that both have, up to a time: RMS over the particles, m.
struct Apart {
  double largest = 0;    // over time
  double over_time = 0;  // RMS over time too
};
Apart distance_over_time(const Trajectory& a, const Trajectory& b, double until);

/// Rows of `speed-accuracy`: no time in them. Notes say what was left out.
void speed_accuracy_on(const Request& request, const Scene& scene, Rows& rows);
/// Rows of `speed-accuracy-timing-cost`: the same runs timed in turns. Long runs are timed over their first part, as
/// each evaluation of a scene without contact costs the same.
void time_speed_accuracy(const Request& request, const Scene& scene, Rows& rows);

/// Adds what follows from both: `speed-accuracy-cost`, the Pareto lines and the cheapest methods (see conclude.cpp).
void conclude_speed_accuracy(Rows& rows);

/// Who compiled the code whose time is measured.
std::string build_of(const std::string& method);

}  // namespace crosscheck
