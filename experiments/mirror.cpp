// Partners are found by their places at the start.
#include "experiments/mirror.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

constexpr int axes[] = {0, 2};

Vec3 reflected(Vec3 p, const Vec3& centre, int axis) {
  p[axis] = 2 * centre[axis] - p[axis];
  return p;
}

}  // namespace

std::optional<Mirror> Mirror::of(const Scene& scene) {
  const Model& model = scene.model;
  const auto* spheres = model.find<Spheres>();
  const auto* gravity = model.find<Gravity>();
  const int n = model.particles.size();
  // every pair is looked at: a second for ten thousand particles
  if (!spheres || spheres->list.size() != 1 || spheres->moving() || model.find<Wind>() || model.find<Aerodynamics>() ||
      model.particles.move || n < 2 || n > 10000 || !scene.start.v.isZero(0))
    return std::nullopt;
  if (gravity && (gravity->acceleration.x() != 0 || gravity->acceleration.z() != 0)) return std::nullopt;
  Mirror mirror;
  mirror.centre_ = spheres->list[0].centre;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < n; ++i) {
      const Vec3 image = reflected(scene.start.x.col(i), mirror.centre_, axes[side]);
      int found = -1;
      for (int j = 0; j < n && found < 0; ++j)
        if ((scene.start.x.col(j) - image).norm() < 1e-12 && model.particles.pinned[i] == model.particles.pinned[j] &&
            model.particles.mass[i] == model.particles.mass[j])
          found = j;
      if (found < 0) return std::nullopt;
      mirror.partner_[side].push_back(found);
    }
  return mirror;
}

double Mirror::asymmetry(const Points& x) const {
  double most = 0;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < x.cols(); ++i)
      most = std::max(most, (x.col(partner_[side][i]) - reflected(x.col(i), centre_, axes[side])).norm());
  return most;
}

}  // namespace crosscheck
