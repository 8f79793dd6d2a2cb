// Random vectors, and conversion of vectors to numbers of a call, for several assignments.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "mysim/model/model.h"
#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"

namespace coursework {

/// Each component is in [-size, size].
inline crosscheck::Vec3 random_vector(Random& random, double size) {
  crosscheck::Vec3 v;
  for (double& part : v) part = random.uniform(-size, size);
  return v;
}

inline crosscheck::Vec3 random_direction(Random& random) {
  if (random.rounds()) {
    crosscheck::Vec3 v(0.36, 0.48, 0.8);
    std::swap(v[random.integer(0, 2)], v[random.integer(0, 2)]);
    for (double& part : v) part *= random.integer(0, 1) ? 1 : -1;
    return v;
  }
  const double height = random.uniform(-0.9, 0.9), angle = random.uniform(0, 2 * std::numbers::pi);
  const double flat = std::sqrt(1 - height * height);
  return {flat * std::cos(angle), height, flat * std::sin(angle)};
}

inline void put(Numbers& out, const crosscheck::Vec3& v) { out.insert(out.end(), v.begin(), v.end()); }
inline void put(Numbers& out, const crosscheck::Points& points) {
  out.insert(out.end(), points.data(), points.data() + points.size());
}

}  // namespace coursework
