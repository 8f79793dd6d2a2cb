// Random spheres, and their encoding as numbers of the calls.
#include "tests/coursework/a4-collision/cases.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace coursework::a4 {

Vec3 random_vector(Random& random, double size) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
  return {x, y, z};
}

Vec3 random_direction(Random& random) {
  if (random.rounds()) {
    Vec3 v(0.36, 0.48, 0.8);
    std::swap(v[random.integer(0, 2)], v[random.integer(0, 2)]);
    for (double& part : v) part *= random.integer(0, 1) ? 1 : -1;
    return v;
  }
  const double height = random.uniform(-0.9, 0.9), angle = random.uniform(0, 2 * std::numbers::pi);
  const double flat = std::sqrt(1 - height * height);
  return {flat * std::cos(angle), height, flat * std::sin(angle)};
}

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

void put(Numbers& out, const Vec3& v) { out.insert(out.end(), {v.x(), v.y(), v.z()}); }
void put(Numbers& out, const Points& points) { out.insert(out.end(), points.data(), points.data() + points.size()); }
void put(Numbers& out, const Sphere& s) {
  put(out, s.centre);
  out.insert(out.end(), {s.radius, s.margin, s.friction, s.restitution});
}

Resolved resolved(const Sphere& sphere, const Vec3& before, Vec3 x, Vec3 v) {
  resolve_contact(sphere, sphere.centre, before, x, v);
  return {x, v};
}

}  // namespace coursework::a4
