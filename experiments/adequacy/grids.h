// The same cloth with another number of particles, and surfaces of different grids at the same points of the material.
#pragma once

#include <optional>

#include "mysim/grid.h"
#include "mysim/scene.h"

namespace crosscheck {

/// The sheet of the scene, read from its text; nothing where it has none, or more than a sheet (a block, single
/// particles beside it), or its springs follow no grid.
std::optional<Grid> sheet_of(const Scene& scene);

/// The scene with n particles along the longer side of its sheet and as many along the other as keep the cells' shape.
/// Pins stay where they are on the material: an edge that is pinned whole stays so, others go to the nearest particle.
/// The step is at most 0.7 of leapfrog's limit. Throws Unsupported without a sheet.
Scene with_resolution(const Scene& scene, int n);

/// The stiffness of all springs multiplied; the step follows.
Scene with_stiffness(Scene scene, double factor);

/// A surface of nu x nv particles (3 x nu nv, m; particle (i, j) in column i + nu j) at the points
/// (p / (m - 1), q / (m - 1)), p, q = 0 ... m - 1, of the unit square of the material, in between by bilinear
/// interpolation: exact where the surface is bilinear in every cell. 3 x m m, point (p, q) in column p + m q.
Points at_material_points(const Points& x, int nu, int nv, int m);

}  // namespace crosscheck
