// Calls of gravity_force and drag_force. Input: the number of particles, then for each one:
//   gravity   mass, g (3)   a row per particle: force (3)
//   drag      drag, v (3)   a row per particle: force (3)
#include "calls_numbers.h"

namespace coursework {

bool answer_gravity_drag(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "gravity" && call != "drag") return false;
  Reader reader(in);
  for (std::size_t left = reader.count(); left > 0; --left) {
    const double factor = reader.number();
    const Vec3 vector = reader.vector<Vec3>();
    put(out, call == "gravity" ? gravity_force(factor, vector) : drag_force(factor, vector));
  }
  return true;
}

}  // namespace coursework
