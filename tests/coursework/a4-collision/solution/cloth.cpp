// A cloth among spheres.
#include <algorithm>

#include "contact.h"

std::vector<Vec3> accelerations(const Cloth& cloth, const State& state) {
  std::vector<Vec3> a = spring_forces(cloth.springs, state.x);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 force = a[i] - cloth.drag * state.v[i];
    a[i] = force / cloth.mass[i] + cloth.gravity;
  }
  for (int pin : cloth.pins) a[pin] = Vec3();
  return a;
}

State cloth_step(const Cloth& cloth, const std::vector<Sphere>& spheres, const State& state, double h) {
  const std::vector<Vec3> a = accelerations(cloth, state);
  State next = state;
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    if (std::count(cloth.pins.begin(), cloth.pins.end(), i) > 0) continue;
    Vec3 v = state.v[i] + h * a[i];
    Vec3 x = state.x[i] + h * v;
    for (const Sphere& sphere : spheres) {
      if (gap(sphere, x) >= 0) continue;
      x = corrected_position(sphere, state.x[i], x);
      v = corrected_velocity(sphere, normal(sphere, x), v);
    }
    next.x[i] = x;
    next.v[i] = v;
  }
  return next;
}
