// Gravity and drag.
#include "pendulum.h"

Vec3 gravity_force(double mass, const Vec3& g) { return mass * g; }

Vec3 drag_force(double drag, const Vec3& v) { return -drag * v; }
