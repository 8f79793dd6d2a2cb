// The velocity after contact: the inward component is reversed and multiplied by e; friction reduces the tangential
// component.
#include "contact.h"

Vec3 corrected_velocity(const Sphere& sphere, const Vec3& n, const Vec3& v) {
  const double inward = dot(v, n);
  if (inward >= 0) return v;
  const double change = -(1 + sphere.restitution) * inward;
  Vec3 tangential = v - inward * n;
  const double l = length(tangential), most = sphere.friction * change;
  tangential = l <= most ? Vec3() : (1 - most / l) * tangential;
  return tangential + (inward + change) * n;
}
