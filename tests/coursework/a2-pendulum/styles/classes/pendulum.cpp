// A pendulum is a chain of two.
#include "pendulum.h"

State pendulum_derivative(const Pendulum& p, const State& state) {
  return chain_derivative(Chain{p.gravity, p.drag, {p.mass, p.mass}, {p.stiffness}, {p.rest}}, state);
}
