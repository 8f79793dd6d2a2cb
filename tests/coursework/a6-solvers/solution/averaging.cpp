// Each spring proposes positions of its ends; each particle moves to the weighted mean of these positions and its own.
#include <cmath>

#include "solvers.h"

std::vector<Vec3> averaging_pass(const Net& net, const std::vector<Vec3>& x) {
  std::vector<Vec3> sum(x.size());
  std::vector<double> count(x.size(), own_weight);
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] = own_weight * x[i];
  for (const Spring& s : net.springs) {
    const Vec3 d = x[s.a] - x[s.b], middle = 0.5 * (x[s.a] + x[s.b]);
    const double l = length(d);
    const Vec3 half = l > 0 ? 0.5 * s.rest / l * d : Vec3();
    sum[s.a] += middle + half;
    sum[s.b] += middle - half;
    count[s.a] += 1;
    count[s.b] += 1;
  }
  std::vector<Vec3> next = x;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!net.held[i]) next[i] = sum[i] / count[i];
  return next;
}

State averaging_step(const Net& net, const State& state, double h, int passes) {
  std::vector<Vec3> x = state.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!net.held[i]) x[i] += h * (velocity_kept * state.v[i] + h * net.gravity);
  for (int k = 0; k < passes; ++k) x = averaging_pass(net, x);
  State after{x, x};
  for (std::size_t i = 0; i < x.size(); ++i) after.v[i] = (x[i] - state.x[i]) / h;
  return after;
}

// a pass leaves (0.2 + 1/2) / (0.2 + 1) of the stretch; at rest, the passes remove the stretch that gravity adds in a
// step
double stiffness_of(double mass, double h, int passes) {
  return mass / (h * h) * (std::pow((own_weight + 1) / (own_weight + 0.5), passes) - 1);
}
