// Wind that varies over time, and its pressure on triangles.
#include "cloth.h"

std::vector<Triangle> triangles(const Grid& grid) {
  std::vector<Triangle> all;
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const int a = index_of(grid, row, column), b = index_of(grid, row, column + 1);
      const int c = index_of(grid, row + 1, column), d = index_of(grid, row + 1, column + 1);
      all.push_back({a, b, c});
      all.push_back({b, d, c});
    }
  return all;
}

Vec3 wind_at(const Wind& wind, double t) {
  const double pi = 3.14159265358979323846;
  const double swing = std::sin(2 * pi * wind.frequency * t + wind.offset);
  return wind.speed * (1 + wind.gust * swing) * wind.direction;
}

std::vector<Vec3> wind_forces(const Wind& wind, const std::vector<Triangle>& triangles, const State& state, double t) {
  std::vector<Vec3> f(state.x.size());
  if (!wind.on) return f;
  const Vec3 air = wind_at(wind, t);
  for (const Triangle& s : triangles) {
    const Vec3 area = 0.5 * cross(state.x[s.b] - state.x[s.a], state.x[s.c] - state.x[s.a]);
    const double size = length(area);
    if (size == 0) continue;
    const Vec3 u = air - (state.v[s.a] + state.v[s.b] + state.v[s.c]) / 3;
    const Vec3 n = area / size;
    const Vec3 force = 0.5 * wind.density * wind.coefficient * size * length(u) * dot(u, n) * n;
    f[s.a] += force / 3;
    f[s.b] += force / 3;
    f[s.c] += force / 3;
  }
  return f;
}
