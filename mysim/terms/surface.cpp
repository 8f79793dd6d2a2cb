#include "mysim/terms/surface.h"

#include <cassert>

#include "mysim/model/model.h"

namespace crosscheck {
namespace {

/// Shortens a vector by at most `by`, never beyond zero.
Vec3 shortened(const Vec3& vector, double by) {
  const double length = vector.norm();
  return length <= by ? Vec3::Zero() : Vec3(vector * (1 - by / length));
}

}  // namespace

bool has_contact(const Model& model) { return model.find<Spheres>() || model.find<Planes>(); }

std::vector<Surface> surfaces_of(const Model& model) {
  std::vector<Surface> surfaces;
  if (const auto* spheres = model.find<Spheres>())
    surfaces.insert(surfaces.end(), spheres->list.begin(), spheres->list.end());
  if (const auto* planes = model.find<Planes>())
    surfaces.insert(surfaces.end(), planes->list.begin(), planes->list.end());
  return surfaces;
}

bool has_moving_surface(const Model& model) {
  const auto* spheres = model.find<Spheres>();
  const auto* planes = model.find<Planes>();
  return (spheres && spheres->moving()) || (planes && planes->moving());
}

double clearance_from(std::span<const Surface> surfaces, double t, const Vec3& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Surface& s : surfaces) smallest = std::min(smallest, s.gap(x - s.origin_at(t)));
  return smallest;
}

double resolve_contact(const Surface& surface, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                       Eigen::Ref<Vec3> v) {
  assert(surface.radius() > 0 && 0 <= surface.restitution && surface.restitution <= 1);
  const double gap = surface.gap(x - origin);
  if (!(gap < 0)) return 0;

  const double push = -gap;
  Vec3 n = surface.normal(x - origin);
  x = surface.put_on(origin, x, n);

  if (surface.friction > 0) {
    const Vec3 moved = x - x_n;
    const Vec3 along_normal = moved.dot(n) * n;
    x = x_n + along_normal + shortened(moved - along_normal, surface.friction * push);
    n = surface.normal(x - origin);
    x = surface.put_on(origin, x, n);
  }

  const double inward = v.dot(n);
  if (inward < 0) {
    const Vec3 tangential = v - inward * n;
    const double change = -(1 + surface.restitution) * inward;
    v = shortened(tangential, surface.friction * change) + (inward + change) * n;
  }
  return push;
}

double resolve_contact_sticky(const Surface& surface, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                              Eigen::Ref<Vec3> v) {
  const double push = -surface.gap(x - origin);
  if (!(push > 0)) return 0;
  x = surface.put_on(origin, x_n, surface.normal(x_n - origin));
  v.setZero();
  return push;
}

}  // namespace crosscheck
