// Calls of part 3.
#include <cmath>

#include "calls_read.h"

namespace coursework {
namespace {

Vec3 rotated(const std::vector<Vec3>& rows, const Vec3& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return std::nan("");
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::fmax(largest, length(a[i] - b[i]));
  return largest;
}

/// Nine numbers that test spring forces of any law: the sum of the forces; the sum of their moments about the origin;
/// the change of the forces when all particles are moved by `shift`; the difference between R f(x) and f(R x); the
/// power f . u.
Numbers laws(const std::vector<Spring>& springs, const std::vector<Vec3>& x, const Vec3& shift,
             const std::vector<Vec3>& rotation, const std::vector<Vec3>& u) {
  const std::vector<Vec3> f = spring_forces(springs, x);
  if (f.size() != x.size()) return {};
  Vec3 sum, moment;
  double power = 0;
  std::vector<Vec3> moved, turned, f_turned;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += f[i];
    moment += cross(x[i], f[i]);
    power += dot(f[i], u[i]);
    moved.push_back(x[i] + shift);
    turned.push_back(rotated(rotation, x[i]));
    f_turned.push_back(rotated(rotation, f[i]));
  }
  Numbers out;
  put(out, sum);
  put(out, moment);
  put(out, Vec3(largest_difference(f, spring_forces(springs, moved)),
                largest_difference(f_turned, spring_forces(springs, turned)), power));
  return out;
}

}  // namespace

/// spring_forces (springs, count, positions), gravity_forces (count, masses, g), drag_forces (c, count, velocities):
/// the force on each particle. spring_laws (springs, count, positions, shift, rotation as three rows, directions u):
/// the result of laws().
bool answer_forces(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  if (call == "spring_forces" || call == "spring_laws") {
    const std::vector<Spring> springs = read_springs(reader);
    const int count = reader.integer();
    const auto x = reader.vectors<Vec3>(count);
    if (call == "spring_forces") {
      put(out, spring_forces(springs, x));
      return true;
    }
    const Vec3 shift = reader.vector<Vec3>();
    const auto rotation = reader.vectors<Vec3>(3);
    out = laws(springs, x, shift, rotation, reader.vectors<Vec3>(count));
  } else if (call == "gravity_forces") {
    const int count = reader.integer();
    const Numbers mass = reader.numbers(count);
    put(out, gravity_forces(mass, reader.vector<Vec3>()));
  } else if (call == "drag_forces") {
    const double c = reader.number();
    const int count = reader.integer();
    put(out, drag_forces(c, reader.vectors<Vec3>(count)));
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
