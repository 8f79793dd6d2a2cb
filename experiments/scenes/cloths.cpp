#include "experiments/scenes/cloths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"

namespace crosscheck {
namespace {

/// A step well below leapfrog's limit, and at most the scene's own step.
double stable_step(const Scene& scene) {
  const double omega = highest_frequency(scene.model, scene.start);
  return omega > 0 ? std::min(scene.step, 1.4 / omega) : scene.step;
}

int other_size(const Grid& g, int n, bool of_u) {
  const int longer = std::max(g.nu, g.nv);
  const double cells = (of_u ? g.nu : g.nv) - 1;
  return std::max(2, 1 + static_cast<int>(std::lround(cells * (n - 1) / (longer - 1))));
}

/// The particles of grid b at the positions that the pins have on grid a.
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

std::optional<Grid> cloth_grid_of(const Scene& scene) {
  if (scene.triangles.empty()) return std::nullopt;
  const Grid grid = read_grid(TomlTable::parse_text(scene.source, scene.name).section("grid"));
  if (grid.nw > 1 || grid.size() != scene.model.particles.size()) return std::nullopt;
  if (scene.model.find<Constraints>()) return std::nullopt;  // the cloth has no stiffness to compare
  const TomlDocument file(scene.source, scene.name);
  if (file.has("spring") || file.has("constraint")) return std::nullopt;
  return grid;
}

Scene with_resolution(const Scene& scene, int n) {
  const auto grid = cloth_grid_of(scene);
  if (!grid) throw Unsupported("it is not a single sheet of cloth");
  Grid other = *grid;
  other.nu = other_size(*grid, n, true);
  other.nv = other_size(*grid, n, false);
  TomlDocument file(scene.source, scene.name);
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

Scene sized_cloth(int n, bool sphere) {
  std::string text = fmt::format(
      "question = \"What does a step of {0} x {0} particles cost?\"\nparameters = \"cloth-hang at another size\"\n"
      "[time]\nduration = 3\nsamples = 90\nstep = {1}\nwindow = 3\ntolerance = 5e-4\nmethod = \"leapfrog\"\n"
      "[grid]\nsize = [{0}, {0}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 0.25\n"
      "[grid.stiffness]\nstructural = 200\nshear = 200\nbend = 200\n[pins]\nparticles = [0, {2}]\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 4\n",
      n, 1e-2 / n, n - 1);
  if (sphere) text += "[sphere]\ncentre = [0, -0.33, 0.5]\nradius = 0.3\nmargin = 0.005\nfriction = 0.3\n";
  Scene scene = parse_scene(text, fmt::format("cloth-{0}x{0}", n));
  constexpr double pi = std::numbers::pi;
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.05 * std::sin(3 * pi * scene.start.x(0, i)) * std::sin(2 * pi * scene.start.x(2, i));
  // the wave does not move the pins, because sin(2 pi z) = 0 at the corners
  return scene;
}

Scene hanging_cloth(int n, const Stiffnesses& stiffnesses) {
  constexpr double mass = 0.25;  // kg
  // omega^2 is at most 8 times the sum of the stiffnesses divided by the mass of a particle; leapfrog is stable up to
  // 2/omega
  const double omega = std::sqrt(8 * (stiffnesses.structural + stiffnesses.shear + stiffnesses.bend) * n * n / mass);
  return parse_scene(
      fmt::format("question = \"What does the same accuracy cost?\"\nparameters = \"a sheet hung by two corners\"\n"
                  "[time]\nduration = 1\nsamples = 10\nstep = {1:.17g}\nwindow = 1\ntolerance = 1e-3\n"
                  "method = \"leapfrog\"\n[grid]\nsize = [{0}, {0}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\n"
                  "v = [0, 0, 1]\nmass = {6}\n[grid.stiffness]\nstructural = {3}\nshear = {4}\nbend = {5}\n"
                  "[pins]\nparticles = [0, {2}]\n[gravity]\nacceleration = [0, -9.81, 0]\n[drag]\ngamma = 5\n",
                  n, 0.72 * 2 / omega, n - 1, stiffnesses.structural, stiffnesses.shear, stiffnesses.bend, mass),
      fmt::format("sheet-{0}x{0}", n));
}

Scene hanging_cloth_of_two_stiffnesses(int n) {
  Scene scene = hanging_cloth(n, {400, 400, 20});
  scene.name += "-two-stiffnesses";
  return scene;
}

Scene hanging_cloth_of_links(int n) {
  Scene scene = hanging_cloth(n);
  scene.name += "-link-law";
  scene.model.find<Springs>()->law = SpringLaw::bullet_link;
  scene.hash = hash_of(scene);
  return scene;
}

}  // namespace crosscheck
