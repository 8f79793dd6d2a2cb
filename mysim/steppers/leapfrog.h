// The leapfrog step, for rules that are composed of it.
#pragma once

#include "mysim/steppers/stepper.h"

namespace crosscheck {

/// Drift h/2, kick h, drift h/2, from state.t; h may be negative. Drag and the other forces on moving particles act at
/// the mean of old and new velocity. Drag alone is solved for exactly; dashpots and air need the new velocity: it is
/// found in `passes` passes, each of which adds a power of h to the accuracy and costs an evaluation. Two keep order 2.
void leapfrog_step(System& f, State& s, double h, int passes, Workspace& w);

}  // namespace crosscheck
