// Expands a grid into particles, springs and triangles.
#include "mysim/grid.h"

namespace crosscheck {

Grid read_grid(const Section& s) {
  Grid g{};
  const std::vector<int> size = s.integers("size");
  if (size.size() != 2 || size[0] < 2 || size[1] < 2 || long(size[0]) * size[1] > 10000000)
    s.fail("size", "two whole numbers from 2, particles along u and v, ten million in all at most");
  g.nu = size[0];
  g.nv = size[1];
  g.origin = s.vec3("origin");
  g.u = s.vec3("u");
  g.v = s.vec3("v");
  if (g.u.cross(g.v).norm() <= 1e-12 * g.u.norm() * g.v.norm()) s.fail("v", "a side that is not parallel to u");
  g.mass = s.positive("mass");
  const Section k = s.section("stiffness");
  g.stiffness.structural = k.positive("structural");
  if (k.has("shear")) g.stiffness.shear = k.positive("shear");
  if (k.has("bend")) g.stiffness.bend = k.positive("bend");
  return g;
}

Points grid_points(const Grid& g) {
  Points x(3, g.nu * g.nv);
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i)
      x.col(i + j * g.nu) = g.origin + double(i) / (g.nu - 1) * g.u + double(j) / (g.nv - 1) * g.v;
  return x;
}

std::vector<Spring> grid_springs(const Grid& g, const Points& x) {
  std::vector<Spring> list;
  auto add = [&](int i0, int j0, int i1, int j1, double k, Family family) {
    if (k == 0 || i0 < 0 || i1 < 0 || i0 >= g.nu || i1 >= g.nu || j1 >= g.nv) return;
    const int a = i0 + j0 * g.nu, b = i1 + j1 * g.nu;
    list.push_back({a, b, k, (x.col(a) - x.col(b)).norm(), family});
  };
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i) {
      add(i, j, i + 1, j, g.stiffness.structural, Family::structural);
      add(i, j, i, j + 1, g.stiffness.structural, Family::structural);
      add(i, j, i + 1, j + 1, g.stiffness.shear, Family::shear);
      add(i + 1, j, i, j + 1, g.stiffness.shear, Family::shear);
      add(i, j, i + 2, j, g.stiffness.bend, Family::bend);
      add(i, j, i, j + 2, g.stiffness.bend, Family::bend);
    }
  return list;
}

std::vector<std::array<int, 3>> grid_triangles(const Grid& g) {
  std::vector<std::array<int, 3>> list;
  for (int j = 0; j + 1 < g.nv; ++j)
    for (int i = 0; i + 1 < g.nu; ++i) {
      const int a = i + j * g.nu, b = a + 1, c = a + g.nu, d = c + 1;
      list.push_back({a, c, b});
      list.push_back({b, c, d});
    }
  return list;
}

}  // namespace crosscheck
