// Part 4: wind. See "Wind that comes and goes" to "Pressure on a triangle" in the hand-out.
#include "cloth.h"

std::vector<Triangle> triangles(const Grid& /*grid*/) {
  return {};  // yours
}

Vec3 wind_at(const Wind& /*wind*/, double /*t*/) {
  return {};  // yours
}

std::vector<Vec3> wind_forces(const Wind& /*wind*/, const std::vector<Triangle>& /*triangles*/, const State& state,
                              double /*t*/) {
  return std::vector<Vec3>(state.x.size());  // yours
}
