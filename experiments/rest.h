// Where a scene comes to rest.
#pragma once

#include <optional>

#include "mysim/scene.h"

namespace crosscheck {

/// The state of rest under gravity, springs and steady winds, pins where they stand at the start: found by dynamic
/// relaxation with kinetic damping (all velocities are set to zero at each peak of the kinetic energy; drag is left
/// out, as it does not move the rest), until the RMS acceleration of the free particles is 1e-5 of what moves them.
/// Nothing where there is no rest to find: first-order scenes, hard distances, spheres, gusts, moving pins, nothing
/// pinned, or no rest within a hundred thousand steps.
std::optional<State> rest_of(const Scene& scene);

}  // namespace crosscheck
