// Gravity and drag.
#include "pendulum.h"

Vec3 gravity_force(double mass, const Vec3& g) {
  (void)mass, (void)g;  // delete this line when you use them
  return {};            // yours
}

Vec3 drag_force(double drag, const Vec3& v) {
  (void)drag, (void)v;  // delete this line when you use them
  return {};            // yours
}
