// The position after contact: the particle moves onto the surface, is held back by friction, and moves onto the surface
// again.
#include "contact.h"

namespace {

/// Spheres and planes share this rule.
template <class Surface>
Vec3 corrected(const Surface& surface, const Vec3& before, const Vec3& proposed) {
  const double depth = -gap(surface, proposed);
  if (depth <= 0) return proposed;
  const Vec3 n = normal(surface, proposed);
  const Vec3 moved = nearest(surface, proposed) - before;
  const Vec3 along = dot(moved, n) * n;
  Vec3 tangential = moved - along;
  const double l = length(tangential), most = surface.friction * depth;
  tangential = l <= most ? Vec3() : (1 - most / l) * tangential;
  return nearest(surface, before + along + tangential);
}

}  // namespace

Vec3 corrected_position(const Sphere& sphere, const Vec3& before, const Vec3& proposed) {
  return corrected(sphere, before, proposed);
}

Vec3 corrected_position(const Plane& plane, const Vec3& before, const Vec3& proposed) {
  return corrected(plane, before, proposed);
}
