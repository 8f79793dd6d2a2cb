// Part 3: the velocity after contact. See "The velocity" in the hand-out.
#include "contact.h"

Vec3 corrected_velocity(const Sphere& /*sphere*/, const Vec3& /*n*/, const Vec3& /*v*/) {
  return {};  // yours: everything stops
}
