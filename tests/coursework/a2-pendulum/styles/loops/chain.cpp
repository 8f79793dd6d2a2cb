// Computes the springs of each particle from its two neighbours, without a list of forces. Positions and velocities are
// in separate arrays.
#include "pendulum.h"

State chain_derivative(const Chain& chain, const State& state) {
  const int n = static_cast<int>(state.size()) / 2;
  std::vector<Vec3> x, v;
  for (std::size_t i = 0; i < state.size(); i++) (i % 2 == 0 ? x : v).push_back(state[i]);
  State rate(state.size());
  for (int i = 1; i < n; i++) {
    Vec3 f = gravity_force(chain.mass[i], chain.gravity) + drag_force(chain.drag, v[i]) +
             spring_force(x[i], x[i - 1], chain.stiffness[i - 1], chain.rest[i - 1]);
    if (i < n - 1) f = f + spring_force(x[i], x[i + 1], chain.stiffness[i], chain.rest[i]);
    rate[2 * i] = v[i];
    rate[2 * i + 1] = f / chain.mass[i];
  }
  return rate;
}
