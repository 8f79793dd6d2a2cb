// Readers shared by the calls of the collision assignment.
#pragma once

#include "contact.h"
#include "states.h"

namespace coursework {

/// Reads centre (3), radius, margin, friction, restitution.
inline Sphere read_sphere(Reader& in) {
  Sphere sphere;
  sphere.centre = in.vector<Vec3>();
  for (double* one : {&sphere.radius, &sphere.margin, &sphere.friction, &sphere.restitution}) *one = in.number();
  return sphere;
}

/// Reads point (3), normal (3), margin, friction.
inline Plane read_plane(Reader& in) {
  Plane plane;
  plane.point = in.vector<Vec3>(), plane.normal = in.vector<Vec3>();
  plane.margin = in.number(), plane.friction = in.number();
  return plane;
}

}  // namespace coursework
