#include "mysim/scene/grid.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "mysim/base/text.h"
#include "mysim/base/this_process.h"

namespace crosscheck {
namespace {

/// Number of springs that grid_springs() makes, including those of an inextensible grid.
double springs_of_grid(const Grid& g) {
  const double a = g.nu, b = g.nv, c = g.nw;
  double count = (a - 1) * b * c + a * (b - 1) * c + a * b * (c - 1);
  if (g.stiffness.shear > 0) count += 2 * ((a - 1) * (b - 1) * c + (a - 1) * b * (c - 1) + a * (b - 1) * (c - 1));
  if (g.stiffness.bend > 0)
    count += std::max(a - 2, 0.) * b * c + a * std::max(b - 2, 0.) * c + a * b * std::max(c - 2, 0.);
  return count;
}

/// Throws InputError with the numbers if a scene made from the grid would not fit into memory. Counts each spring twice
/// (the list, and its copy when it is passed on and sorted), and each particle's position, velocity and mass.
void require_memory_of_grid(const TomlTable& s, const Grid& g) {
  const double springs = springs_of_grid(g);
  const double stencils = g.bending > 0 ? 3. * g.size() : 0;
  const double bytes =
      springs * 2 * sizeof(Spring) + stencils * 2 * sizeof(Bending::Stencil) + g.size() * 16. * sizeof(double);
  const double free = free_memory();
  if (bytes > free)
    s.fail("size", fmt::format("a grid that fits into the {} of free memory, got {} particles with {:.0f} "
                               "springs, which need at least {}",
                               format_bytes(free), g.size(), springs, format_bytes(bytes)));
}

}  // namespace

Grid read_grid(const TomlTable& s) {
  Grid g{};
  const std::vector<int> size = s.integers("size");
  long particles = 1;
  bool good = size.size() == 2 || size.size() == 3;
  for (int n : size) good = good && n >= 2 && (particles *= n) <= 10000000;
  if (!good)
    s.fail("size", fmt::format("two whole numbers from 2 (cloth) or three (a block), particles along u, v and w, at "
                               "most ten million in all, got [{}]",
                               fmt::join(size, ", ")));
  g.nu = size[0];
  g.nv = size[1];
  g.nw = size.size() == 3 ? size[2] : 1;
  g.origin = s.vec3("origin");
  g.u = s.vec3("u");
  g.v = s.vec3("v");
  for (const char* side : {"u", "v"})
    if (s.vec3(side).norm() == 0) s.fail(side, "a side of non-zero length");
  if (g.u.cross(g.v).norm() <= 1e-12 * g.u.norm() * g.v.norm()) s.fail("v", "a side that is not parallel to u");
  g.w = Vec3::Zero();
  if (g.nw == 1 && s.has("w")) s.fail("w", "no w with a size of two numbers (a cloth; a block has three)");
  if (g.nw > 1) {
    g.w = s.vec3("w");
    if (!(g.u.cross(g.v).dot(g.w) > 1e-12 * g.u.norm() * g.v.norm() * g.w.norm()))
      s.fail("w", "a side out of the plane of u and v, on the side of u x v");
  }
  g.mass = s.positive("mass");
  const bool inextensible = s.has("inextensible");
  if (inextensible) {
    if (const std::string family = s.text("inextensible", "\"structural\", the one family that can keep its lengths");
        family != "structural")
      s.fail("inextensible",
             fmt::format("\"structural\", the one family that can keep its lengths, got \"{}\"", family));
    g.stiffness.structural = std::numeric_limits<double>::infinity();
  }
  if (!inextensible || s.has("stiffness")) {
    const TomlTable k = s.section("stiffness");
    if (inextensible && k.has("structural"))
      k.fail("structural", "no stiffness with inextensible = \"structural\", which replaces springs by hard distances");
    if (!inextensible) g.stiffness.structural = k.positive("structural");
    if (k.has("shear")) g.stiffness.shear = k.positive("shear");
    if (k.has("bend")) g.stiffness.bend = k.positive("bend");
  }
  if (s.has("dashpot")) g.dashpot = s.positive("dashpot");
  if (s.has("bending")) {
    g.bending = s.positive("bending");
    if (g.nw > 1) s.fail("bending", "no bending with a size of three numbers (only a cloth bends)");
    // 1e-9 allows for the rounding of decimal numbers
    if (std::abs(g.u.dot(g.v)) > 1e-9 * g.u.norm() * g.v.norm())
      s.fail("bending", "no bending unless u and v are at right angles");
  }
  require_memory_of_grid(s, g);
  return g;
}

Points grid_points(const Grid& g) {
  Points x(3, g.size());
  for (int l = 0; l < g.nw; ++l)
    for (int j = 0; j < g.nv; ++j)
      for (int i = 0; i < g.nu; ++i) {
        Vec3 p = g.origin + double(i) / (g.nu - 1) * g.u + double(j) / (g.nv - 1) * g.v;
        if (g.nw > 1) p += double(l) / (g.nw - 1) * g.w;
        x.col(i + g.nu * (j + g.nv * l)) = p;
      }
  return x;
}

std::vector<Spring> grid_springs(const Grid& g) {
  std::vector<Spring> list;
  list.reserve((g.nw > 1 ? 12L : 6L) * g.size());  // 12 or 6 begin at an inner particle; large cloths fill the memory
  const Vec3* side[3] = {&g.u, &g.v, &g.w};
  const int size[3] = {g.nu, g.nv, g.nw}, stride[3] = {1, g.nu, g.nu * g.nv};
  using Steps = std::array<int, 3>;
  auto inside = [&](const Steps& at) {
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] < 0 || at[axis] >= size[axis]) return false;
    return true;
  };
  auto add = [&](const Steps& from, const Steps& to, double k, Family family) {
    if (k == 0 || !inside(from) || !inside(to)) return;
    int a = 0, b = 0;
    Vec3 apart = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      a += stride[axis] * from[axis], b += stride[axis] * to[axis];
      if (size[axis] > 1) apart += double(to[axis] - from[axis]) / (size[axis] - 1) * *side[axis];
    }
    list.push_back({a, b, k, apart.norm(), family});
  };
  auto moved = [](Steps at, int axis, int by) {
    at[axis] += by;
    return at;
  };
  for (int l = 0; l < g.nw; ++l)
    for (int j = 0; j < g.nv; ++j)
      for (int i = 0; i < g.nu; ++i) {
        const Steps here{i, j, l};
        for (int axis = 0; axis < 3; ++axis)
          add(here, moved(here, axis, 1), g.stiffness.structural, Family::structural);
        for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
          add(here, moved(moved(here, p, 1), q, 1), g.stiffness.shear, Family::shear);
          add(moved(here, p, 1), moved(here, q, 1), g.stiffness.shear, Family::shear);
        }
        for (int axis = 0; axis < 3; ++axis) add(here, moved(here, axis, 2), g.stiffness.bend, Family::bend);
      }
  return list;
}

Bending grid_bending(const Grid& g) {
  const double p = g.u.norm() / (g.nu - 1), q = g.v.norm() / (g.nv - 1);
  Bending bending{{}, g.bending};
  const auto row = [&](int middle, int stride, double k) {
    bending.list.push_back({3, {middle - stride, middle, middle + stride}, {1, -2, 1}, k});
  };
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i) {
      const int here = i + g.nu * j;
      const bool at_end_of_u = i == 0 || i == g.nu - 1, at_end_of_v = j == 0 || j == g.nv - 1;
      if (!at_end_of_u) row(here, 1, (at_end_of_v ? 0.5 : 1) * g.bending * q / (p * p * p));
      if (!at_end_of_v) row(here, g.nu, (at_end_of_u ? 0.5 : 1) * g.bending * p / (q * q * q));
      if (i + 1 < g.nu && j + 1 < g.nv)
        bending.list.push_back(
            {4, {here, here + 1, here + g.nu, here + g.nu + 1}, {1, -1, -1, 1}, 2 * g.bending / (p * q)});
    }
  return bending;
}

std::vector<std::array<int, 3>> grid_triangles(const Grid& g) {
  std::vector<std::array<int, 3>> list;
  // adds a face of n by m particles, beginning with particle `first`, with the given strides
  auto face = [&](int first, int n, int step_n, int m, int step_m) {
    for (int j = 0; j + 1 < m; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        const int a = first + i * step_n + j * step_m, b = a + step_n, c = a + step_m, d = c + step_n;
        list.push_back({a, c, b});
        list.push_back({b, c, d});
      }
  };
  const int u = 1, v = g.nu, w = g.nu * g.nv;
  const int far_u = (g.nu - 1) * u, far_v = (g.nv - 1) * v, far_w = (g.nw - 1) * w;
  face(0, g.nu, u, g.nv, v);  // the normal of (a, c, b) is v x u: outward at l = 0
  if (g.nw > 1) {
    face(far_w, g.nv, v, g.nu, u);
    face(0, g.nw, w, g.nu, u);
    face(far_v, g.nu, u, g.nw, w);
    face(0, g.nv, v, g.nw, w);
    face(far_u, g.nw, w, g.nv, v);
  }
  return list;
}

}  // namespace crosscheck
