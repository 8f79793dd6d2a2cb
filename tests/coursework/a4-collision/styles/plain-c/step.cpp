// Plain loops: first all velocities, then all positions, then all contacts.
#include <iostream>

#include "contact.h"
using namespace std;

State contact_step(const Sphere& sphere, const State& state, const Vec3& g, double h) {
  State s = state;
  int n = (int)s.x.size();
  for (int i = 0; i < n; i++) s.v[i] += g * h;
  for (int i = 0; i < n; i++) s.x[i] += s.v[i] * h;
  int touching = 0;
  for (int i = 0; i < n; i++) {
    if (gap(sphere, s.x[i]) >= 0) continue;
    touching++;
    s.x[i] = corrected_position(sphere, state.x[i], s.x[i]);
    s.v[i] = corrected_velocity(sphere, normal(sphere, s.x[i]), s.v[i]);
  }
  if (touching > 0 && n > 1) cout << touching << " particles touch" << endl;
  return s;
}
