// Part 1: where are the sphere and the plane? See "Distance and normal" and "A plane" in the hand-out.
#include "contact.h"

double gap(const Sphere& /*sphere*/, const Vec3& /*x*/) {
  return 0;  // yours
}

Vec3 normal(const Sphere& /*sphere*/, const Vec3& /*x*/) {
  return {};  // yours
}

Vec3 nearest(const Sphere& /*sphere*/, const Vec3& x) {
  return x;  // yours
}

double gap(const Plane& /*plane*/, const Vec3& /*x*/) {
  return 0;  // yours
}

Vec3 nearest(const Plane& /*plane*/, const Vec3& x) {
  return x;  // yours
}
