// Computes x + h (x' + h v'), which is the same if x' = v.
#include "pendulum.h"

State symplectic_step(const Derivative& f, const State& state, double h) {
  State next(state);
  const State rate = f(state);
  for (std::size_t particle = 0; particle < state.size() / 2; ++particle) {
    const Vec3 dv = rate[2 * particle + 1] * h;
    next[2 * particle] += h * (rate[2 * particle] + dv);
    next[2 * particle + 1] += dv;
  }
  return next;
}
