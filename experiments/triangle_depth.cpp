// The nearest point of a triangle, by the region of its plane that the point projects into.
#include "experiments/triangle_depth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  return length2 > 0 ? Vec3(a + std::clamp((p - a).dot(d) / length2, 0.0, 1.0) * d) : a;
}

}  // namespace

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double area2 = n.squaredNorm();
  if (area2 > 0) {
    // weights of the foot of the perpendicular; inside when none is negative
    const double wa = (c - b).cross(p - b).dot(n), wb = (a - c).cross(p - c).dot(n), wc = (b - a).cross(p - a).dot(n);
    if (wa >= 0 && wb >= 0 && wc >= 0) return (wa * a + wb * b + wc * c) / (wa + wb + wc);
  }
  Vec3 best = nearest_on_segment(p, a, b);
  for (const Vec3& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  return best;
}

std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x) {
  const auto* spheres = scene.model.find<Spheres>();
  if (!spheres || scene.triangles.empty()) return std::nullopt;
  double deepest = -INFINITY;
  for (const Sphere& sphere : spheres->list) {
    const Vec3 centre = sphere.centre_at(t);
    for (const auto& [a, b, c] : scene.triangles)
      deepest = std::max(deepest, sphere.contact_radius() -
                                      (nearest_on_triangle(centre, x.col(a), x.col(b), x.col(c)) - centre).norm());
  }
  return deepest;
}

}  // namespace crosscheck
