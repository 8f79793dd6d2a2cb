// Readers shared by the calls of the cloth assignment. A grid is encoded as rows, columns, across, down, corner (3).
#pragma once

#include "cloth.h"
#include "numbers.h"

namespace coursework {

inline Grid read_grid(Reader& in) {
  Grid grid;
  grid.rows = in.integer();
  grid.columns = in.integer();
  grid.across = in.number();
  grid.down = in.number();
  grid.corner = in.vector<Vec3>();
  return grid;
}

/// Reads the number of springs, then `a`, `b`, `k`, `rest` of each.
inline std::vector<Spring> read_springs(Reader& in) {
  std::vector<Spring> all(in.integer());
  for (Spring& s : all) {
    s.a = in.integer();
    s.b = in.integer();
    s.k = in.number();
    s.rest = in.number();
  }
  return all;
}

/// Reads `on` (1 or 0), direction (3), speed, gust, frequency, offset, density, coefficient.
inline Wind read_wind(Reader& in) {
  Wind wind;
  wind.on = in.integer() != 0;
  wind.direction = in.vector<Vec3>();
  for (double* one : {&wind.speed, &wind.gust, &wind.frequency, &wind.offset, &wind.density, &wind.coefficient})
    *one = in.number();
  return wind;
}

/// Reads the number of triangles, then the three corners of each.
inline std::vector<Triangle> read_triangles(Reader& in) {
  std::vector<Triangle> all(in.integer());
  for (Triangle& t : all) {
    t.a = in.integer();
    t.b = in.integer();
    t.c = in.integer();
  }
  return all;
}

}  // namespace coursework
