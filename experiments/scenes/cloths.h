// Square cloths of any size, and the cloth of a scene with a different number of particles or stiffness.
#pragma once

#include <optional>

#include "mysim/scene/grid.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

/// The cloth grid of the scene's text. Returns nullopt if the text has no grid, if there are other elements (a block,
/// single particles), or if the springs do not follow the grid.
std::optional<Grid> cloth_grid_of(const Scene& scene);

/// The scene with n particles along the longer side of its cloth, and as many along the other side as preserve the
/// shape of the cells. Pins stay at the same position on the material: a completely pinned edge remains pinned, other
/// pins move to the nearest particle. The step is at most 0.7 of leapfrog's limit. Throws Unsupported if the scene has
/// no cloth.
Scene with_resolution(const Scene& scene, int n);

/// Multiplies all spring stiffnesses by the factor, and adapts the step.
Scene with_stiffness(Scene scene, double factor);

/// Samples a surface of nu x nv particles (3 x nu nv, m; particle (i, j) in column i + nu j) at the points (p / (m -
/// 1), q / (m - 1)), p, q = 0 ... m - 1, of the unit square of the material, by bilinear interpolation. Returns 3 x m m
/// values, with point (p, q) in column p + m q.
Points at_material_points(const Points& x, int nu, int nv, int m);

/// cloth-hang with n x n particles: 1 m, 0.25 kg in total, 200 N/m for all three families, two corners pinned, drag
/// 4/s. The step of 1e-2 s / n is 0.45 of the explicit limit at each size, because the mass of a particle scales as
/// n^-2. Starts as a wave 5 cm high, so that springs pull from the first step on. `sphere`: adds a sphere with a radius
/// of 0.3 m below the middle.
Scene sized_cloth(int n, bool sphere = false);

/// Spring stiffnesses, N/m.
struct Stiffnesses {
  double structural = 400, shear = 200, bend = 20;
};

/// A cloth of n x n particles, 1 m by 1 m and 0.25 kg, initially flat, hanging by two corners of one edge; drag 5/s,
/// gravity 9.81 m/s^2, duration 1 s. The damping is so strong that no wrinkles grow from rounding errors; wrinkles
/// would make the error of every method random. Its step is below every explicit rule's limit.
Scene hanging_cloth(int n, const Stiffnesses& stiffnesses = {});

/// hanging_cloth() with equal structural and shear stiffness, as Bullet's own spring force requires.
Scene hanging_cloth_of_two_stiffnesses(int n);

/// hanging_cloth() with the law of Bullet's position-based links instead of Hooke's (mysim/terms/springs.h). The links
/// converge to that law, so this cloth separates the error of their solver from that of their model.
Scene hanging_cloth_of_links(int n);

}  // namespace crosscheck
