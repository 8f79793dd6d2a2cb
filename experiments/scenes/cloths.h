// Square cloths of any size, and the cloth of a scene with another number of particles or another stiffness.
#pragma once

#include <optional>

#include "mysim/scene/grid.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

// The same cloth with another number of particles, and surfaces of different grids at the same points of the material.

/// The cloth grid of the scene, read from its text; nothing where it has none, or more than one (a block, single
/// particles beside it), or its springs follow no grid.
std::optional<Grid> cloth_grid_of(const Scene& scene);

/// The scene with n particles along the longer side of its cloth and as many along the other as keep the cells' shape.
/// Pins stay where they are on the material: an edge that is pinned whole stays so, others go to the nearest particle.
/// The step is at most 0.7 of leapfrog's limit. Throws Unsupported without a cloth.
Scene with_resolution(const Scene& scene, int n);

/// The stiffness of all springs multiplied; the step follows.
Scene with_stiffness(Scene scene, double factor);

/// A surface of nu x nv particles (3 x nu nv, m; particle (i, j) in column i + nu j) at the points
/// (p / (m - 1), q / (m - 1)), p, q = 0 ... m - 1, of the unit square of the material, in between by bilinear
/// interpolation: exact where the surface is bilinear in every cell. 3 x m m, point (p, q) in column p + m q.
Points at_material_points(const Points& x, int nu, int nv, int m);

// The cloth of the scene cloth-hang at other resolutions.

/// cloth-hang with n x n particles: 1 m, 0.25 kg in all, 200 N/m for all three families, two corners pinned, drag 4/s.
/// The step is 1e-2 s / n, 0.45 of the explicit limit at each size, since particles get lighter as n^-2. It begins as a
/// wave 5 cm high, so that springs pull from the first step on. With a sphere (0.3 m) below its middle where requested.
Scene sized_cloth(int n, bool sphere = false);

// The scene that all engines are timed on.

/// N/m: along the threads, across the cells, over two of them.
struct Stiffnesses {
  double structural = 400, shear = 200, bend = 20;
};

/// A cloth of n x n particles, 1 m by 1 m and 0.25 kg, flat at the start, hanging by two corners of one edge; drag 5/s
/// in sum, 9.81 m/s^2, 1 s. Damped so much that no wrinkle grows out of rounding: with less the error of every method
/// would be that of chance. Its step is below every explicit rule's limit.
Scene hanging_cloth(int n, const Stiffnesses& stiffnesses = {});

/// The same with as much stiffness across the cells as along the threads: two stiffnesses in all, which Bullet's own
/// spring force can carry.
Scene hanging_cloth_of_two_stiffnesses(int n);

/// The same with the law of Bullet's position-based links in place of Hooke's (mysim/terms/springs.h): what they
/// converge to, so that their error can be separated from their model's.
Scene hanging_cloth_of_links(int n);

}  // namespace crosscheck
