// The gradient of the function that the implicit step minimises, and a pass that descends along this gradient.
#include "solvers.h"

std::vector<Vec3> gradient(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  const double inertia = net.mass / (h * h);
  std::vector<Vec3> g(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) g[i] = inertia * (x[i] - ahead[i]) - net.mass * net.gravity;
  for (const Spring& s : net.springs) {
    const Vec3 d = x[s.a] - x[s.b];
    const double l = length(d);
    if (l == 0) continue;
    const Vec3 pull = net.stiffness * (l - s.rest) / l * d;
    g[s.a] += pull;
    g[s.b] -= pull;
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    if (net.held[i]) g[i] = Vec3();
  return g;
}

std::vector<Vec3> jacobi_pass(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  const std::vector<Vec3> g = gradient(net, ahead, x, h);
  const double slope = net.mass / (h * h) + 4 * net.stiffness;
  std::vector<Vec3> next = x;
  for (std::size_t i = 0; i < x.size(); ++i) next[i] -= g[i] / slope;
  return next;
}
