// How deep a surface is inside a ball: its particles, and the triangles between them.
#pragma once

#include <optional>

#include "mysim/scene.h"

namespace crosscheck {

/// Point of the triangle a b c nearest to p, m.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// How far the deepest point of the scene's triangles is inside a contact surface at time t (s), m; negative outside.
/// A triangle cuts a ball although its corners lie on it. Nothing without spheres or without triangles.
std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x);

}  // namespace crosscheck
