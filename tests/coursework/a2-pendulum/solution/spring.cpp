// Hooke's law along the line between the ends.
#include "pendulum.h"

Vec3 spring_force(const Vec3& a, const Vec3& b, double stiffness, double rest) {
  const Vec3 d = a - b;
  const double now = length(d);
  if (now == 0) return {};
  return -stiffness * (now - rest) * (d / now);
}
