// Two loops: all velocities, then all positions.
#include "pendulum.h"

State symplectic_step(const Derivative& f, const State& state, double h) {
  State rate = f(state), next(state.size());
  for (std::size_t i = 1; i < state.size(); i += 2) next[i] = state[i] + rate[i] * h;
  for (std::size_t i = 0; i < state.size(); i += 2) next[i] = state[i] + next[i + 1] * h;
  return next;
}
