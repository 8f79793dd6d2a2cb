// A regular cloth stepped by the fused step: rules composed only of kicks and drifts, in one pass over memory per kick.
#pragma once

#include <memory>

#include "mysim/run/engine.h"

namespace crosscheck::simd {

/// Null if the general engine is required, which has three possible reasons. The rule is not composed of kicks and
/// drifts (or has several kicks, and there are contact surfaces). The scene has terms other than springs, gravity,
/// drag, uniform wind and contact surfaces. Its springs form no regular grid, or one that is too narrow. Results differ
/// from the general engine only by the order of sums.
std::unique_ptr<World> make_cloth_grid_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                             const Execution& execution, const Observer& observer);

}  // namespace crosscheck::simd
