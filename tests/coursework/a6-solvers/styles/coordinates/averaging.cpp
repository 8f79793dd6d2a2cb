// Each spring proposes shifts of its ends instead of positions.
#include "solvers.h"

std::vector<Vec3> averaging_pass(const Net& net, const std::vector<Vec3>& x) {
  std::vector<Vec3> shift(x.size());
  std::vector<int> springs(x.size());
  for (const Spring& spring : net.springs) {
    Vec3 d = x[spring.b] - x[spring.a];
    double l = length(d);
    springs[spring.a]++, springs[spring.b]++;
    if (l == 0) continue;
    d *= (1 - spring.rest / l) / 2;
    shift[spring.a] += d, shift[spring.b] -= d;
  }
  std::vector<Vec3> next;
  for (size_t i = 0; i < x.size(); i++)
    next.push_back(net.held[i] ? x[i] : x[i] + shift[i] / (springs[i] + own_weight));
  return next;
}

State averaging_step(const Net& net, const State& state, double h, int passes) {
  State s = state;
  for (size_t i = 0; i < s.x.size(); i++) {
    if (net.held[i]) continue;
    s.v[i] *= velocity_kept;
    s.v[i] += h * net.gravity;
    s.x[i] += h * s.v[i];
  }
  // the shifts of all passes add to the velocity
  for (int k = 0; k < passes; k++) {
    std::vector<Vec3> moved = averaging_pass(net, s.x);
    for (size_t i = 0; i < moved.size(); i++) s.v[i] += (moved[i] - s.x[i]) / h;
    s.x = moved;
  }
  return s;
}

double stiffness_of(double mass, double h, int passes) {
  double left = 1;
  while (passes-- > 0) left *= 0.7 / 1.2;
  return mass * (1 - left) / (left * h * h);
}
