// One step of free particles with contact.
#include "contact.h"

State contact_step(const Sphere& sphere, const State& state, const Vec3& g, double h) {
  State next = state;
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    Vec3 v = state.v[i] + h * g;
    Vec3 x = state.x[i] + h * v;
    if (gap(sphere, x) < 0) {
      x = corrected_position(sphere, state.x[i], x);
      v = corrected_velocity(sphere, normal(sphere, x), v);
    }
    next.x[i] = x;
    next.v[i] = v;
  }
  return next;
}
