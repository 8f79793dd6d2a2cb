// Grids of another resolution, by the scene's own text.
#include "experiments/adequacy/grids.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mysim/errors.h"
#include "mysim/frequency.h"

namespace crosscheck {
namespace {

/// The step that leapfrog bears with room to spare, or the scene's own where that is smaller.
double stable_step(const Scene& scene) {
  const double omega = fastest_frequency(scene.model, scene.start);
  return omega > 0 ? std::min(scene.step, 1.4 / omega) : scene.step;
}

int other_size(const Grid& g, int n, bool of_u) {
  const int longer = std::max(g.nu, g.nv);
  const double cells = (of_u ? g.nu : g.nv) - 1;
  return std::max(2, 1 + static_cast<int>(std::lround(cells * (n - 1) / (longer - 1))));
}

/// Particles of the grid b that stand where the pins stand on the grid a.
std::vector<int> pins_on(const Grid& a, const Grid& b, const std::vector<int>& pins) {
  const std::set<int> pinned(pins.begin(), pins.end());
  std::set<int> in_edges, out;
  const auto edge = [&](bool along_u, bool far) {
    const auto index = [&](const Grid& g, int k) {
      const int fixed = far ? (along_u ? g.nv : g.nu) - 1 : 0;
      return along_u ? k + g.nu * fixed : fixed + g.nu * k;
    };
    const int na = along_u ? a.nu : a.nv, nb = along_u ? b.nu : b.nv;
    for (int k = 0; k < na; ++k)
      if (!pinned.contains(index(a, k))) return;
    for (int k = 0; k < na; ++k) in_edges.insert(index(a, k));
    for (int k = 0; k < nb; ++k) out.insert(index(b, k));
  };
  for (const bool along_u : {true, false})
    for (const bool far : {true, false}) edge(along_u, far);
  for (const int pin : pins) {
    if (in_edges.contains(pin)) continue;
    const double u = double(pin % a.nu) / (a.nu - 1), v = double(pin / a.nu) / (a.nv - 1);
    out.insert(static_cast<int>(std::lround(u * (b.nu - 1))) + b.nu * static_cast<int>(std::lround(v * (b.nv - 1))));
  }
  return {out.begin(), out.end()};
}

}  // namespace

std::optional<Grid> sheet_of(const Scene& scene) {
  if (scene.triangles.empty()) return std::nullopt;
  const Grid grid = read_grid(Section::parse_text(scene.source, scene.name).section("grid"));
  if (grid.nw > 1 || grid.size() != scene.model.particles.size()) return std::nullopt;
  if (scene.model.find<Constraints>()) return std::nullopt;  // hard distances have no stiffness to compare
  const Document file(scene.source, scene.name);
  if (file.has("spring") || file.has("constraint")) return std::nullopt;
  return grid;
}

Scene with_resolution(const Scene& scene, int n) {
  const auto grid = sheet_of(scene);
  if (!grid) throw Unsupported("it is no single sheet of cloth");
  Grid other = *grid;
  other.nu = other_size(*grid, n, true);
  other.nv = other_size(*grid, n, false);
  Document file(scene.source, scene.name);
  file.set("grid.size", std::vector<int>{other.nu, other.nv});
  if (!scene.model.particles.pins.empty())
    file.set("pins.particles", pins_on(*grid, other, scene.model.particles.pins));
  Scene out = parse_scene(file.text(), scene.name);
  out.step = stable_step(out);
  return out;
}

Scene with_stiffness(Scene scene, double factor) {
  for (Spring& s : scene.model.find<Springs>()->list) s.k *= factor;
  scene.step = stable_step(scene);
  scene.hash = hash_of(scene);
  return scene;
}

Points at_material_points(const Points& x, int nu, int nv, int m) {
  Points out(3, m * m);
  for (int q = 0; q < m; ++q)
    for (int p = 0; p < m; ++p) {
      const double u = double(p) / (m - 1) * (nu - 1), v = double(q) / (m - 1) * (nv - 1);
      const int i = std::min(static_cast<int>(u), nu - 2), j = std::min(static_cast<int>(v), nv - 2);
      const double a = u - i, b = v - j;
      const int at = i + nu * j;
      out.col(p + m * q) = (1 - a) * (1 - b) * x.col(at) + a * (1 - b) * x.col(at + 1) + (1 - a) * b * x.col(at + nu) +
                           a * b * x.col(at + nu + 1);
    }
  return out;
}

}  // namespace crosscheck
