// The derivative with the standard algorithms: copies the velocities, and sums the forces list by list.
#include <algorithm>
#include <numeric>

#include "cloth.h"

namespace {

std::vector<Vec3> sum(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), [](const Vec3& p, const Vec3& q) { return p + q; });
  return a;
}

}  // namespace

State derivative(const Cloth& cloth, const State& state, double t) {
  auto a = sum(sum(gravity_forces(cloth.mass, cloth.gravity), wind_forces(cloth.wind, cloth.triangles, state, t)),
               sum(spring_forces(cloth.springs, state.x), drag_forces(cloth.drag, state.v)));
  std::transform(a.begin(), a.end(), cloth.mass.begin(), a.begin(), [](const Vec3& f, double m) { return f / m; });
  State rate{state.v, std::move(a)};
  std::for_each(cloth.pins.begin(), cloth.pins.end(), [&](int i) { rate.x[i] = rate.v[i] = Vec3{}; });
  return rate;
}
