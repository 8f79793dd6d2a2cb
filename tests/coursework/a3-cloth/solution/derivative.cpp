// The right-hand side of the whole cloth: x' = v and v' = F / m; pins do not move.
#include "cloth.h"

State derivative(const Cloth& cloth, const State& state, double t) {
  const std::vector<Vec3> springs = spring_forces(cloth.springs, state.x);
  const std::vector<Vec3> gravity = gravity_forces(cloth.mass, cloth.gravity);
  const std::vector<Vec3> drag = drag_forces(cloth.drag, state.v);
  const std::vector<Vec3> wind = wind_forces(cloth.wind, cloth.triangles, state, t);
  State rate;
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const Vec3 force = springs[i] + gravity[i] + drag[i] + wind[i];
    rate.x.push_back(state.v[i]);
    rate.v.push_back(force / cloth.mass[i]);
  }
  for (int pin : cloth.pins) {
    rate.x[pin] = Vec3();
    rate.v[pin] = Vec3();
  }
  return rate;
}
