// Part 2: the position after contact. See "The position" in the hand-out.
#include "contact.h"

Vec3 corrected_position(const Sphere& /*sphere*/, const Vec3& /*before*/, const Vec3& /*proposed*/) {
  return {};  // yours
}

Vec3 corrected_position(const Plane& /*plane*/, const Vec3& /*before*/, const Vec3& /*proposed*/) {
  return {};  // yours
}
