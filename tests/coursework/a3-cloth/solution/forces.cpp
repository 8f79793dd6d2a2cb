// Forces of springs, gravity and drag.
#include "cloth.h"

std::vector<Vec3> spring_forces(const std::vector<Spring>& springs, const std::vector<Vec3>& x) {
  std::vector<Vec3> f(x.size());
  for (const Spring& s : springs) {
    const Vec3 d = x[s.a] - x[s.b];
    const double l = length(d);
    if (l == 0) continue;  // the ends met: no direction
    const Vec3 on_a = (-s.k * (l - s.rest) / l) * d;
    f[s.a] += on_a;
    f[s.b] -= on_a;
  }
  return f;
}

std::vector<Vec3> gravity_forces(const std::vector<double>& mass, const Vec3& g) {
  std::vector<Vec3> f;
  for (double m : mass) f.push_back(m * g);
  return f;
}

std::vector<Vec3> drag_forces(double c, const std::vector<Vec3>& v) {
  std::vector<Vec3> f;
  for (const Vec3& velocity : v) f.push_back(-c * velocity);
  return f;
}
