// A regular cloth under the fused step: rules that are kicks and drifts alone, in one pass over memory a kick.
#pragma once

#include <memory>

#include "mysim/run/engine.h"

namespace crosscheck::simd {

/// Null where the general engine has to do it: the rule is not a chain of kicks and drifts (or one of several, and
/// there are spheres), the scene has terms other than springs, gravity, drag, uniform wind and spheres, or its springs
/// are no regular grid or one too narrow. Nothing else differs but the order of sums.
std::unique_ptr<World> make_cloth_grid_world(const Stepper& stepper, ContactRule contact, const Scene& scene, double h,
                                             const Execution& execution, const Observer& observer);

}  // namespace crosscheck::simd
