// Loops over coordinates; for each particle, over its springs.
#include "solvers.h"

static double Vec3::*const axes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

std::vector<Vec3> gradient(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  int n = (int)x.size();
  std::vector<Vec3> g(n);
  for (int i = 0; i < n; i++) {
    if (net.held[i]) continue;
    for (auto axis : axes) g[i].*axis = net.mass * ((x[i].*axis - ahead[i].*axis) / h / h - net.gravity.*axis);
    for (const Spring& spring : net.springs) {
      if (spring.a != i && spring.b != i) continue;
      int other = spring.a == i ? spring.b : spring.a;
      double squared = 0;
      for (auto axis : axes) squared += std::pow(x[i].*axis - x[other].*axis, 2);
      double l = std::sqrt(squared);
      if (l > 0)
        for (auto axis : axes) g[i].*axis += net.stiffness * (1 - spring.rest / l) * (x[i].*axis - x[other].*axis);
    }
  }
  return g;
}

std::vector<Vec3> jacobi_pass(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  std::vector<Vec3> g = gradient(net, ahead, x, h);
  double scale = h * h / (net.mass + 4 * net.stiffness * h * h);
  for (size_t i = 0; i < x.size(); i++) g[i] = x[i] - scale * g[i];
  return g;
}
