// Passes start from the positions to which velocity alone would lead; Chebyshev's weights extrapolate each pass.
#include "solvers.h"

std::vector<double> weights(int passes, double rho) {
  std::vector<double> w;
  for (int k = 0; k < passes; ++k) {
    double weight = 1;
    if (k == 1) weight = 2 / (2 - rho * rho);
    if (k > 1) weight = 4 / (4 - rho * rho * w[k - 1]);
    w.push_back(weight);
  }
  return w;
}

State implicit_step(const Net& net, const State& state, double h, int passes, double rho) {
  std::vector<Vec3> ahead = state.x;
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += h * velocity_kept * state.v[i];
  std::vector<Vec3> x = ahead, last = ahead;
  for (const double weight : weights(passes, rho)) {
    std::vector<Vec3> next = jacobi_pass(net, ahead, x, h);
    for (std::size_t i = 0; i < x.size(); ++i) next[i] = last[i] + weight * (next[i] - last[i]);
    last = x;
    x = next;
  }
  State after{x, x};
  for (std::size_t i = 0; i < x.size(); ++i) after.v[i] = (x[i] - state.x[i]) / h;
  return after;
}
