// One function computes the offset from the centre; all others call it.
#include <tuple>

#include "contact.h"

namespace {

const auto seen_from_centre = [](const Sphere& sphere, const Vec3& x) {
  const Vec3 d = x - sphere.centre;
  const double l = std::sqrt(dot(d, d));
  return std::make_tuple(l > 0 ? (1 / l) * d : Vec3{0, 1, 0}, l);
};

}  // namespace

double gap(const Sphere& sphere, const Vec3& x) {
  return std::get<double>(seen_from_centre(sphere, x)) - sphere.radius - sphere.margin;
}

Vec3 normal(const Sphere& sphere, const Vec3& x) { return std::get<Vec3>(seen_from_centre(sphere, x)); }

Vec3 nearest(const Sphere& sphere, const Vec3& x) {
  const auto [n, distance] = seen_from_centre(sphere, x);
  (void)distance;
  return n * (sphere.radius + sphere.margin) + sphere.centre;
}

double gap(const Plane& plane, const Vec3& x) {
  return dot(plane.normal, x) - (dot(plane.normal, plane.point) + plane.margin);
}

Vec3 nearest(const Plane& plane, const Vec3& x) {
  const Vec3 foot = plane.point + plane.margin * plane.normal, d = x - foot;
  return foot + (d - dot(d, plane.normal) * plane.normal);
}
