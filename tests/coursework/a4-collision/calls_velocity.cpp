// Calls of part 3.
#include "calls_read.h"

namespace coursework {

/// corrected_velocity (sphere, count, normal and velocity of each particle): the corrected velocity of each particle.
bool answer_velocity(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "corrected_velocity") return false;
  Reader reader(in);
  const Sphere sphere = read_sphere(reader);
  for (int left = reader.integer(); left > 0; --left) {
    const Vec3 n = reader.vector<Vec3>(), v = reader.vector<Vec3>();
    put(out, corrected_velocity(sphere, n, v));
  }
  return true;
}

}  // namespace coursework
