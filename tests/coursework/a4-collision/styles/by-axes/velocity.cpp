// The velocity is split along the normal and along the direction of sliding.
#include <algorithm>

#include "contact.h"

Vec3 corrected_velocity(const Sphere& sphere, const Vec3& n, const Vec3& v) {
  double along_n = dot(v, n);
  if (along_n >= 0) return v;
  const Vec3 slide = v - along_n * n;
  double speed = length(slide);
  const Vec3 direction = speed > 0 ? slide / speed : Vec3();
  const double bounced = -sphere.restitution * along_n;
  speed = std::max(0.0, speed - sphere.friction * (bounced - along_n));
  return bounced * n + speed * direction;
}
