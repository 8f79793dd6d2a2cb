// The parts of a scene that no method moves, for the player: triangles, springs, obstacles.
#pragma once

#include "mysim/base/json.h"
#include "mysim/scene/scene.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {

Json packed_json(const PackedNumbers& packed);
Json vector_json(const Vec3& v);

/// Corners of the surface; null without one.
Json triangles_json(const Scene& scene);
/// Ends and rest lengths of hard distances and springs, family after family; those of the surface's threads come first.
Json springs_json(const Scene& scene);
/// Obstacles; the centre of one that moves at each of the times (s).
Json spheres_json(const Scene& scene, const std::vector<double>& times);

}  // namespace crosscheck
