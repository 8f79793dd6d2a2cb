// The position after contact: onto the surface, held back by friction, onto the surface again.
#include "contact.h"

Vec3 corrected_position(const Sphere& sphere, const Vec3& before, const Vec3& proposed) {
  const double depth = -gap(sphere, proposed);
  if (depth <= 0) return proposed;
  const Vec3 n = normal(sphere, proposed);
  const Vec3 moved = nearest(sphere, proposed) - before;
  const Vec3 along = dot(moved, n) * n;
  Vec3 tangential = moved - along;
  const double l = length(tangential), most = sphere.friction * depth;
  tangential = l <= most ? Vec3() : (1 - most / l) * tangential;
  return nearest(sphere, before + along + tangential);
}
