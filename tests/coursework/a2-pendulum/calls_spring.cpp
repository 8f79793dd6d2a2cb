// Calls of spring_force. Input: the number of springs, then for each one: stiffness, rest, a (3), b (3).
//   spring   two rows per spring: the force (3) on the particle at a, then the force on the particle at b
#include "calls_numbers.h"

namespace coursework {

bool answer_spring(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "spring") return false;
  Reader reader(in);
  for (std::size_t left = reader.count(); left > 0; --left) {
    const double stiffness = reader.number(), rest = reader.number();
    const Vec3 a = reader.vector<Vec3>(), b = reader.vector<Vec3>();
    put(out, spring_force(a, b, stiffness, rest));
    put(out, spring_force(b, a, stiffness, rest));
  }
  return true;
}

}  // namespace coursework
