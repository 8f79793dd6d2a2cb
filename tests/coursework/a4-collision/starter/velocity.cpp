// Part 3: the velocity after contact. Handout, "The velocity".
#include "contact.h"

Vec3 corrected_velocity(const Sphere& /*sphere*/, const Vec3& /*n*/, const Vec3& /*v*/) {
  return {};  // yours: everything stops
}
