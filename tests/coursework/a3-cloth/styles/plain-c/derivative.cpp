// Plain loops over an array of forces; looks up each pin separately.
#include "cloth.h"
using namespace std;

static bool is_pin(const Cloth& cloth, int i) {
  for (size_t j = 0; j < cloth.pins.size(); j++)
    if (cloth.pins[j] == i) return true;
  return false;
}

State derivative(const Cloth& cloth, const State& state, double t) {
  int n = (int)state.x.size();
  vector<vector<Vec3>> forces;
  forces.push_back(spring_forces(cloth.springs, state.x));
  forces.push_back(drag_forces(cloth.drag, state.v));
  if (cloth.wind.on) forces.push_back(wind_forces(cloth.wind, cloth.triangles, state, t));
  State result = state;
  for (int i = 0; i < n; i++) {
    if (is_pin(cloth, i)) {
      result.x[i] = Vec3(0, 0, 0);
      result.v[i] = Vec3(0, 0, 0);
      continue;
    }
    Vec3 acceleration = cloth.gravity;
    for (size_t j = 0; j < forces.size(); j++) acceleration += (1 / cloth.mass[i]) * forces[j][i];
    result.x[i] = state.v[i];
    result.v[i] = acceleration;
  }
  return result;
}
