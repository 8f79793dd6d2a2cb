// Component by component, as one writes it before one trusts operators.
#include "pendulum.h"

Vec3 gravity_force(double mass, const Vec3& g) {
  Vec3 f;
  f.x = mass * g.x;
  f.y = mass * g.y;
  f.z = mass * g.z;
  return f;
}

Vec3 drag_force(double drag, const Vec3& v) {
  Vec3 f;
  f.x = -drag * v.x;
  f.y = -drag * v.y;
  f.z = -drag * v.z;
  return f;
}
