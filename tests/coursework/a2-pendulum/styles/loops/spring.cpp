// Distinguishes three cases: stretched, shortened, neither.
#include "pendulum.h"

Vec3 spring_force(const Vec3& a, const Vec3& b, double stiffness, double rest) {
  const double stretch = length(b - a) - rest;
  if (length(b - a) == 0.0 || stretch == 0.0) return Vec3{0, 0, 0};
  const Vec3 to_b = (b - a) / length(b - a);
  return stretch > 0 ? stiffness * stretch * to_b : -(stiffness * -stretch * to_b);
}
