// One loop over particles, with a copy of the pins as a set.
#include <set>

#include "contact.h"

std::vector<Vec3> accelerations(const Cloth& cloth, const State& state) {
  const std::set<int> pins(cloth.pins.begin(), cloth.pins.end());
  const std::vector<Vec3> pull = spring_forces(cloth.springs, state.x);
  std::vector<Vec3> a;
  for (int i = 0; i < static_cast<int>(pull.size()); ++i)
    a.push_back(pins.count(i) ? Vec3()
                              : (pull[i] + cloth.mass[i] * cloth.gravity - cloth.drag * state.v[i]) / cloth.mass[i]);
  return a;
}

State cloth_step(const Cloth& cloth, const std::vector<Sphere>& spheres, const State& state, double h) {
  const std::set<int> pins(cloth.pins.begin(), cloth.pins.end());
  const auto a = accelerations(cloth, state);
  auto next = state;
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    Vec3 &x = next.x[i], &v = next.v[i];
    if (pins.find(i) != pins.end()) continue;
    v += h * a[i];
    x += h * v;
    for (const auto& ball : spheres) {
      const bool touches = gap(ball, x) < 0;
      x = corrected_position(ball, state.x[i], x);
      if (touches) v = corrected_velocity(ball, normal(ball, x), v);
    }
  }
  return next;
}
