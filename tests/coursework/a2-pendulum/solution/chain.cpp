// Particles in a row, the first one fixed: forces are gathered first, then turned into rates.
#include "pendulum.h"

State chain_derivative(const Chain& c, const State& state) {
  const std::size_t n = c.mass.size();
  std::vector<Vec3> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    force[i] += gravity_force(c.mass[i], c.gravity);
    force[i] += drag_force(c.drag, state[2 * i + 1]);
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3 pull = spring_force(state[2 * i], state[2 * (i + 1)], c.stiffness[i], c.rest[i]);
    force[i] += pull;
    force[i + 1] -= pull;
  }
  // the fixed particle has no part in this: its rates stay zero
  State rate(2 * n);
  for (std::size_t i = 1; i < n; ++i) {
    rate[2 * i] = state[2 * i + 1];
    rate[2 * i + 1] = force[i] / c.mass[i];
  }
  return rate;
}
