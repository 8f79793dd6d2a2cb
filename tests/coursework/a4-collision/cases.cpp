#include "tests/coursework/a4-collision/cases.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace coursework::a4 {

Vec3 random_tangent(Random& random, const Vec3& n) {
  const Vec3 one = n.unitOrthogonal(), other = n.cross(one);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return std::cos(angle) * one + std::sin(angle) * other;
}

Sphere random_sphere(Random& random, double friction, double restitution) {
  const Vec3 centre = Vec3(1, -1, 2) + random_vector(random, 0.5);
  const double radius = random.uniform(0.5, 1.5);
  return {centre, radius, random.uniform(0.02, 0.05), friction, restitution, std::nullopt};
}

Vec3 random_gravity(Random& random) { return random.uniform(5, 15) * random_direction(random); }

void put(Numbers& out, const Sphere& s) {
  put(out, s.centre);
  out.insert(out.end(), {s.radius, s.margin, s.friction, s.restitution});
}

Resolved resolved(const Sphere& sphere, const Vec3& before, Vec3 x, Vec3 v) {
  resolve_contact(sphere, sphere.centre, before, x, v);
  return {x, v};
}

}  // namespace coursework::a4
