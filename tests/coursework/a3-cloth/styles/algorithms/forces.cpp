// Forces with the standard algorithms.
#include <algorithm>
#include <functional>
#include <iterator>

#include "cloth.h"

using std::vector;

vector<Vec3> spring_forces(const vector<Spring>& springs, const vector<Vec3>& x) {
  vector<Vec3> f(x.size(), Vec3{0, 0, 0});
  std::for_each(springs.begin(), springs.end(), [&](const Spring& s) {
    const Vec3 towards_b = x[s.b] - x[s.a];
    const double now = length(towards_b);
    if (!(now > 0)) return;
    const auto pull = s.k * (now - s.rest) * (towards_b / now);
    f[s.a] += pull;
    f[s.b] -= pull;
  });
  return f;
}

vector<Vec3> gravity_forces(const vector<double>& mass, const Vec3& g) {
  vector<Vec3> f;
  std::transform(mass.cbegin(), mass.cend(), std::back_inserter(f), [&g](double m) { return g * m; });
  return f;
}

vector<Vec3> drag_forces(double c, const vector<Vec3>& v) {
  vector<Vec3> f(v);
  for (auto& one : f) one *= -c;
  return f;
}
