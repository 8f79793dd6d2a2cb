// Symplectic Euler: velocities first, then positions with the new velocities.
#include "pendulum.h"

State symplectic_step(const Derivative& f, const State& state, double h) {
  const State rate = f(state);
  State next = state;
  for (std::size_t i = 0; i + 1 < state.size(); i += 2) {
    next[i + 1] += h * rate[i + 1];
    next[i] += h * next[i + 1];
  }
  return next;
}
