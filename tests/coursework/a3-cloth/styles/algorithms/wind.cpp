// Wind on triangles: first the pressure, then the share of each corner.
#include <array>
#include <cmath>
#include <numeric>

#include "cloth.h"

std::vector<Triangle> triangles(const Grid& grid) {
  std::vector<Triangle> all;
  // the lower triangles of all cells, then the upper ones; the order of corners differs from the hand-out
  for (int r = 1; r < grid.rows; ++r)
    for (int c = 1; c < grid.columns; ++c)
      all.push_back({index_of(grid, r, c), index_of(grid, r - 1, c), index_of(grid, r, c - 1)});
  for (int r = 1; r < grid.rows; ++r)
    for (int c = 1; c < grid.columns; ++c)
      all.push_back({index_of(grid, r, c - 1), index_of(grid, r - 1, c), index_of(grid, r - 1, c - 1)});
  return all;
}

Vec3 wind_at(const Wind& wind, double t) {
  const double turn = 8 * std::atan(1.0);
  return wind.direction * (wind.speed + wind.speed * wind.gust * std::sin(turn * wind.frequency * t + wind.offset));
}

std::vector<Vec3> wind_forces(const Wind& wind, const std::vector<Triangle>& triangles, const State& state, double t) {
  std::vector<Vec3> f(state.x.size());
  if (wind.on)
    for (const auto& [a, b, c] : triangles) {
      const std::array<int, 3> corners{a, b, c};
      const Vec3 v = std::accumulate(corners.begin(), corners.end(), Vec3(),
                                     [&](const Vec3& sum, int i) { return sum + state.v[i]; });
      const Vec3 u = wind_at(wind, t) - v * (1.0 / 3);
      // one product contains both twice the area and the sine of the angle between plate and air
      const Vec3 doubled = cross(state.x[b] - state.x[a], state.x[c] - state.x[a]);
      if (length(doubled) == 0) continue;
      const double pressure = wind.density * wind.coefficient * length(u) * dot(u, doubled) / length(doubled) / 4;
      for (int i : corners) f[i] += pressure / 3 * doubled;
    }
  return f;
}
