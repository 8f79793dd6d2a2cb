// A regular cloth stepped by the fused step: rules of kicks and drifts only, in one pass over memory per kick.
#pragma once

#include <memory>

#include "mysim/run/engine.h"

namespace crosscheck::simd {

/// Null if only the general engine can step the scene: if the rule is not composed of kicks and drifts (or has several
/// kicks, and there are contact surfaces); if there are terms other than springs, gravity, drag, uniform wind and
/// contact surfaces; or if the springs form no regular grid, or one that is too narrow. Results differ from the general
/// engine's only by the order of sums.
std::unique_ptr<World> make_cloth_grid_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                             const Execution& execution, const Observer& observer);

}  // namespace crosscheck::simd
