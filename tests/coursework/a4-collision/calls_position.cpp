// Calls of part 2.
#include "calls_read.h"

namespace coursework {

/// corrected_position (sphere, count, before and proposed of each).
bool answer_position(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "corrected_position") return false;
  Reader reader(in);
  const Sphere sphere = read_sphere(reader);
  for (int left = reader.integer(); left > 0; --left) {
    const Vec3 before = reader.vector<Vec3>(), proposed = reader.vector<Vec3>();
    put(out, corrected_position(sphere, before, proposed));
  }
  return true;
}

}  // namespace coursework
