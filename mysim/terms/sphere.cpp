// Contact of one particle with the sphere: position, friction, velocity.
#include "mysim/terms/sphere.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace crosscheck {
namespace {

/// The vector shortened by at most `by`, never beyond zero.
Vec3 shortened(const Vec3& vector, double by) {
  const double length = vector.norm();
  return length <= by ? Vec3::Zero() : Vec3(vector * (1 - by / length));
}

/// Outward unit normal at x; up where x is the very centre and no direction is better than another.
Vec3 normal_at(const Vec3& centre, const Vec3& x) {
  const Vec3 d = x - centre;
  const double length = d.norm();
  return length > 0 ? Vec3(d / length) : Vec3(0, 1, 0);
}

}  // namespace

double clearance_from(const Spheres& spheres, double t, const Vec3& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Sphere& s : spheres.list) smallest = std::min(smallest, (x - s.centre_at(t)).norm() - s.contact_radius());
  return smallest;
}

double resolve_contact(const Sphere& sphere, const Vec3& centre, const Vec3& x_n, Eigen::Ref<Vec3> x,
                       Eigen::Ref<Vec3> v) {
  const double distance = (x - centre).norm();
  const double radius = sphere.contact_radius();
  assert(radius > 0 && 0 <= sphere.restitution && sphere.restitution <= 1);
  if (!(distance < radius)) return 0;

  // put the particle on the surface
  const double push = radius - distance;
  Vec3 n = normal_at(centre, x);
  x = centre + radius * n;

  // friction holds back the tangential displacement of this step
  if (sphere.friction > 0) {
    const Vec3 moved = x - x_n;
    const Vec3 along_normal = moved.dot(n) * n;
    x = x_n + along_normal + shortened(moved - along_normal, sphere.friction * push);
    n = normal_at(centre, x);
    x = centre + radius * n;
  }

  // no velocity into the sphere, and friction in proportion to what was removed
  const double inward = v.dot(n);
  if (inward < 0) {
    const Vec3 tangential = v - inward * n;
    const double change = -(1 + sphere.restitution) * inward;
    v = shortened(tangential, sphere.friction * change) + (inward + change) * n;
  }
  return push;
}

double resolve_contact_sticky(const Sphere& sphere, const Vec3& centre, const Vec3& x_n, Eigen::Ref<Vec3> x,
                              Eigen::Ref<Vec3> v) {
  const double distance = (x - centre).norm();
  if (!(distance < sphere.contact_radius())) return 0;
  x = centre + sphere.contact_radius() * normal_at(centre, x_n);
  v.setZero();
  return sphere.contact_radius() - distance;
}

}  // namespace crosscheck
