// Calls of part 1. The input is a sphere (for `plane`: a plane), the number of points, and the points.
#include "calls_read.h"

namespace coursework {

/// gap, normal, nearest: the function of this name at each point. normal_and_nearest: normal and nearest point for each
/// point. plane: gap and nearest point for each point.
bool answer_closest(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "plane") {
    Reader reader(in);
    const Plane plane = read_plane(reader);
    for (const Vec3& x : reader.vectors<Vec3>(reader.count())) {
      out.push_back(gap(plane, x));
      put(out, nearest(plane, x));
    }
    return true;
  }
  if (call != "gap" && call != "normal" && call != "nearest" && call != "normal_and_nearest") return false;
  Reader reader(in);
  const Sphere sphere = read_sphere(reader);
  for (const Vec3& x : reader.vectors<Vec3>(reader.integer())) {
    if (call == "gap") out.push_back(gap(sphere, x));
    if (call == "normal" || call == "normal_and_nearest") put(out, normal(sphere, x));
    if (call == "nearest" || call == "normal_and_nearest") put(out, nearest(sphere, x));
  }
  return true;
}

}  // namespace coursework
