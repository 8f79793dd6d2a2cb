// Momenta: forces times h change the momenta, and the momenta move the particles.
#include "contact.h"

std::vector<Vec3> accelerations(const Cloth& cloth, const State& state) {
  std::vector<Vec3> f = spring_forces(cloth.springs, state.x);
  std::vector<bool> held(f.size(), false);
  for (int pin : cloth.pins) held[pin] = true;
  for (std::size_t i = 0; i < f.size(); ++i) {
    f[i] += cloth.mass[i] * cloth.gravity;
    f[i] -= cloth.drag * state.v[i];
    f[i] *= held[i] ? 0 : 1 / cloth.mass[i];
  }
  return f;
}

State cloth_step(const Cloth& cloth, const std::vector<Sphere>& spheres, const State& state, double h) {
  const std::vector<Vec3> a = accelerations(cloth, state);
  State next{state.x, state.v};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 impulse = h * cloth.mass[i] * a[i];
    next.v[i] += impulse / cloth.mass[i];
    next.x[i] += h * next.v[i];
  }
  for (const Sphere& sphere : spheres)
    for (std::size_t i = 0; i < a.size(); ++i)
      if (gap(sphere, next.x[i]) < 0) {
        next.x[i] = corrected_position(sphere, state.x[i], next.x[i]);
        next.v[i] = corrected_velocity(sphere, normal(sphere, next.x[i]), next.v[i]);
      }
  for (int pin : cloth.pins) {
    next.x[pin] = state.x[pin];
    next.v[pin] = state.v[pin];
  }
  return next;
}
