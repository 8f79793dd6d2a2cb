// The unknown is the change from `ahead`, as one vector of Vec3 and lambdas over it.
#include <algorithm>
#include <utility>

#include "solvers.h"

std::vector<double> weights(int passes, double rho) {
  std::vector<double> w(static_cast<std::size_t>(passes), 1.0);
  double before = 2;  // with it, the formula of the later weights holds for the second weight, too
  for (std::size_t k = 1; k < w.size(); ++k) before = w[k] = 4 / (4 - rho * rho * before);
  return w;
}

State implicit_step(const Net& net, const State& state, double h, int passes, double rho) {
  const auto combined = [](const std::vector<Vec3>& a, double s, const std::vector<Vec3>& b) {
    std::vector<Vec3> sum(a.size());
    std::transform(a.begin(), a.end(), b.begin(), sum.begin(), [s](const Vec3& p, const Vec3& q) { return p + s * q; });
    return sum;
  };
  const std::vector<Vec3> ahead = combined(state.x, h * velocity_kept, state.v);
  std::vector<Vec3> before = ahead, now = ahead;
  for (double w : weights(passes, rho)) {
    const std::vector<Vec3> jacobi = jacobi_pass(net, ahead, now, h);
    std::vector<Vec3> next = combined(combined(before, -w, before), w, jacobi);
    before = std::exchange(now, std::move(next));
  }
  std::vector<Vec3> v = combined(now, -1, state.x);
  for (Vec3& one : v) one *= 1 / h;
  return {now, v};
}
