// A lambda for each particle; the state is built from the results.
#include <algorithm>
#include <utility>

#include "contact.h"

State contact_step(const Sphere& sphere, const State& state, const Vec3& g, double h) {
  const auto advance = [&](const Vec3& x0, const Vec3& v0) -> std::pair<Vec3, Vec3> {
    const Vec3 v1 = v0 + g * h, x1 = x0 + v0 * h + g * (h * h);
    if (!(gap(sphere, x1) < 0)) return {x1, v1};
    const Vec3 x2 = corrected_position(sphere, x0, x1);
    return {x2, corrected_velocity(sphere, normal(sphere, x2), v1)};
  };
  State next;
  std::transform(state.x.begin(), state.x.end(), state.v.begin(), std::back_inserter(next.x),
                 [&](const Vec3& x, const Vec3& v) { return advance(x, v).first; });
  std::transform(state.x.begin(), state.x.end(), state.v.begin(), std::back_inserter(next.v),
                 [&](const Vec3& x, const Vec3& v) { return advance(x, v).second; });
  return next;
}
