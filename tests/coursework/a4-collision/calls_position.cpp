// Calls of part 2.
#include "calls_read.h"

namespace coursework {

/// corrected_position (sphere, count, `before` and `proposed` of each particle): each corrected position.
/// on_plane: the same, with a plane instead of the sphere.
bool answer_position(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "corrected_position" && call != "on_plane") return false;
  Reader reader(in);
  const bool flat = call == "on_plane";
  const Plane plane = flat ? read_plane(reader) : Plane();
  const Sphere sphere = flat ? Sphere() : read_sphere(reader);
  for (int left = reader.integer(); left > 0; --left) {
    const Vec3 before = reader.vector<Vec3>(), proposed = reader.vector<Vec3>();
    put(out, flat ? corrected_position(plane, before, proposed) : corrected_position(sphere, before, proposed));
  }
  return true;
}

}  // namespace coursework
