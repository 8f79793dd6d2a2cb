// Computes accelerations directly instead of forces.
#include "pendulum.h"

State pendulum_derivative(const Pendulum& p, const State& state) {
  State f(4);
  f[2] = state[3];
  f[3] = p.gravity - p.drag / p.mass * state[3] + spring_force(state[2], state[0], p.stiffness, p.rest) * (1 / p.mass);
  return f;
}
