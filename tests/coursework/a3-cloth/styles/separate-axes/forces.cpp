// Structure of arrays: x, y and z are separate, and combined at the end.
#include <array>
#include <cmath>
#include <valarray>

#include "cloth.h"

namespace {

using Axis = std::valarray<double>;
using Axes = std::array<Axis, 3>;

Axes apart(const std::vector<Vec3>& all) {
  Axes axes{Axis(all.size()), Axis(all.size()), Axis(all.size())};
  for (std::size_t i = 0; i < all.size(); ++i) axes[0][i] = all[i].x, axes[1][i] = all[i].y, axes[2][i] = all[i].z;
  return axes;
}

std::vector<Vec3> together(const Axes& axes) {
  std::vector<Vec3> all(axes[0].size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {axes[0][i], axes[1][i], axes[2][i]};
  return all;
}

}  // namespace

std::vector<Vec3> spring_forces(const std::vector<Spring>& springs, const std::vector<Vec3>& x) {
  const Axes at = apart(x);
  Axes f{Axis(x.size()), Axis(x.size()), Axis(x.size())};
  for (const Spring& s : springs) {
    double squared = 0;
    for (const Axis& q : at) squared += (q[s.a] - q[s.b]) * (q[s.a] - q[s.b]);
    if (squared == 0) continue;
    const double factor = s.k * (1 - s.rest / std::sqrt(squared));
    for (int axis = 0; axis < 3; ++axis) {
      const double pull = factor * (at[axis][s.a] - at[axis][s.b]);
      f[axis][s.a] -= pull;
      f[axis][s.b] += pull;
    }
  }
  return together(f);
}

std::vector<Vec3> gravity_forces(const std::vector<double>& mass, const Vec3& g) {
  const Axis m(mass.data(), mass.size());
  return together({Axis(m * g.x), Axis(m * g.y), Axis(m * g.z)});
}

std::vector<Vec3> drag_forces(double c, const std::vector<Vec3>& v) {
  Axes axes = apart(v);
  for (Axis& axis : axes) axis *= -c;
  return together(axes);
}
