// Component by component, with the direction from this end to the other end and a positive pull.
#include "pendulum.h"

Vec3 spring_force(const Vec3& a, const Vec3& b, double stiffness, double rest) {
  double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  double now = std::sqrt(dx * dx + dy * dy + dz * dz);
  double s = 0;
  if (now > 0) s = stiffness * (1 - rest / now);
  return Vec3{s * dx, s * dy, s * dz};
}
