// Calls of part 4.
#include <algorithm>
#include <array>

#include "calls_read.h"

namespace coursework {

/// triangles (a grid): the corners of each triangle in ascending order; the triangles are sorted, too.
/// wind_at (wind, count, times): velocity of the air at each time.
/// wind_forces (wind, triangles, count, positions, velocities, t): the force on each particle.
bool answer_wind(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "triangles") {
    std::vector<std::array<int, 3>> all;
    for (const Triangle& t : triangles(read_grid(reader))) {
      all.push_back({t.a, t.b, t.c});
      std::sort(all.back().begin(), all.back().end());
    }
    std::sort(all.begin(), all.end());
    for (const auto& corners : all) out.insert(out.end(), corners.begin(), corners.end());
  } else if (call == "wind_at") {
    const Wind wind = read_wind(reader);
    for (double t : reader.numbers(reader.integer())) put(out, wind_at(wind, t));
  } else if (call == "wind_forces") {
    const Wind wind = read_wind(reader);
    const std::vector<Triangle> faces = read_triangles(reader);
    const int count = reader.integer();
    State state;
    state.x = reader.vectors<Vec3>(count);
    state.v = reader.vectors<Vec3>(count);
    put(out, wind_forces(wind, faces, state, reader.number()));
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
