// Part 3: forces of springs, gravity and drag. See "The force of a spring" to "Gravity and drag" in the hand-out.
#include "cloth.h"

std::vector<Vec3> spring_forces(const std::vector<Spring>& /*springs*/, const std::vector<Vec3>& x) {
  return std::vector<Vec3>(x.size());  // yours: no force at all
}

std::vector<Vec3> gravity_forces(const std::vector<double>& mass, const Vec3& /*g*/) {
  return std::vector<Vec3>(mass.size());  // yours
}

std::vector<Vec3> drag_forces(double /*c*/, const std::vector<Vec3>& v) {
  return std::vector<Vec3>(v.size());  // yours
}
