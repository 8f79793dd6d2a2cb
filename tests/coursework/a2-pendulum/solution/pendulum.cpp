// One particle that hangs on a fixed one.
#include "pendulum.h"

State pendulum_derivative(const Pendulum& p, const State& state) {
  const Vec3 anchor = state[0], x = state[2], v = state[3];
  Vec3 force = gravity_force(p.mass, p.gravity);
  force += drag_force(p.drag, v);
  force += spring_force(x, anchor, p.stiffness, p.rest);
  return {Vec3{}, Vec3{}, v, force / p.mass};
}
