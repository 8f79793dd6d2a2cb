// Computes the weights in the loop over passes, and stores the positions of the last two passes.
#include "solvers.h"

std::vector<double> weights(int passes, double rho) {
  std::vector<double> all;
  double w = 1;
  for (int k = 1; k <= passes; k++) {
    all.push_back(w);
    w = k == 1 ? 2 / (2 - rho * rho) : 4 / (4 - rho * rho * w);
  }
  return all;
}

State implicit_step(const Net& net, const State& state, double h, int passes, double rho) {
  State s = state;
  for (size_t i = 0; i < s.x.size(); i++) {
    s.v[i] *= velocity_kept;
    s.x[i] += h * s.v[i];
  }
  const std::vector<Vec3> ahead = s.x;
  std::vector<Vec3> last = s.x;
  double w = 1;
  for (int k = 0; k < passes; k++) {
    if (k == 1) w = 2 / (2 - rho * rho);
    if (k >= 2) w = 4 / (4 - rho * rho * w);
    const std::vector<Vec3> old = s.x;
    s.x = jacobi_pass(net, ahead, s.x, h);
    for (size_t i = 0; i < s.x.size(); i++) s.x[i] = w * s.x[i] + (1 - w) * last[i];
    last = old;
  }
  for (size_t i = 0; i < s.x.size(); i++) s.v[i] += (s.x[i] - ahead[i]) / h;
  return s;
}
