// Two impulses for unit mass: one along the normal, one against the sliding, limited by Coulomb's cone.
#include <cmath>

#include "contact.h"

Vec3 corrected_velocity(const Sphere& sphere, const Vec3& n, const Vec3& v) {
  const double approach = -dot(v, n);
  if (!(approach > 0)) return v;
  const double normal_impulse = (1 + sphere.restitution) * approach;
  Vec3 after = v;
  after += normal_impulse * n;
  // the impulse that stops the sliding, limited by Coulomb's cone
  Vec3 friction_impulse = cross(n, cross(n, v));
  const double wanted = length(friction_impulse), allowed = sphere.friction * normal_impulse;
  if (wanted > allowed) friction_impulse *= allowed / wanted;
  after += friction_impulse;
  return after;
}
