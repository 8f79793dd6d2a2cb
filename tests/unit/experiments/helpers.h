#pragma once

#include <fmt/ranges.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "reference/method.h"
#include "reference/truth/exact/elastica.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck::testing_tools {

/// Time (s) of the first sample at which a particle touches the sphere (closer than 1e-9 of the scene's size).
inline std::optional<double> first_contact(const Scene& scene, const Trajectory& trajectory) {
  for (int i = 0; i < trajectory.frames(); ++i)
    if (const auto gap = clearance(scene, trajectory.t[i], trajectory.x[i]); gap && *gap < 1e-9 * scene.size())
      return trajectory.t[i];
  return std::nullopt;
}

inline std::string text_of(const std::string& name) {
  std::ifstream in(std::filesystem::path(CROSSCHECK_SOURCE) / "experiments/scenes" / (name + ".toml"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A shipped scene of one cloth with n x n particles. The pins remain on one edge or two corners.
inline Scene with_grid(const std::string& name, int n) {
  const Scene shipped = load_scene(name);
  std::string text = text_of(name);
  text = std::regex_replace(text, std::regex(R"(\nsize = \[[^\]]*\])"), fmt::format("\nsize = [{}, {}]", n, n));
  const std::vector<int>& old = shipped.model.particles.pins;
  std::vector<int> pins{0, n - 1};
  if (old.size() > 2) {
    pins.resize(n);
    for (int i = 0; i < n; ++i) pins[i] = old[1] == 1 ? i : i * n;  // along the first row, or along the first column
  }
  text = std::regex_replace(text, std::regex(R"(\nparticles = \[[^\]]*\])"),
                            fmt::format("\nparticles = [{}]", fmt::join(pins, ", ")));
  return parse_scene(text, fmt::format("{}-{}", name, n));
}

inline Scene with_lengths(Scene scene, double factor) {
  scene.start.x *= factor;
  scene.start.v *= factor;
  scene.model.particles.pin_home *= factor;
  if (scene.model.particles.move) scene.model.particles.move->amplitude *= factor;
  if (auto* springs = scene.model.find<Springs>())
    for (Spring& s : springs->list) s.rest *= factor;
  return scene;
}

/// A shipped scene in three sizes. They differ in the resolution of the grid or, for scenes without a grid, in lengths.
inline std::vector<Scene> three_sizes(const std::string& name) {
  const Scene scene = load_scene(name);
  // a strip of two rows has no square grid
  if (scene.triangles.empty() || name == "cloth-cantilever")
    return {with_lengths(scene, 0.5), scene, with_lengths(scene, 2)};
  std::vector<int> sizes{10, 15, 20};
  if (name == "cloth-student") sizes = {4, 6, 8};  // larger cloths are chaotic
  if (name == "flag") sizes = {6, 9, 12};          // finer ones flutter
  std::vector<Scene> scenes;
  for (const int n : sizes) scenes.push_back(with_grid(name, n));
  return scenes;
}

/// Continuum model of a strip of two rows of particles, clamped half way between its first two columns.
inline ClampedStrip strip_of(const Scene& scene) {
  const Points& x = scene.start.x;
  const double d = x(0, 1) - x(0, 0), columns = static_cast<double>(x.cols()) / 2;
  return {
      .rigidity = scene.model.find<Bending>()->rigidity,
      .length = (columns - 1) * d,
      .weight = -scene.model.find<Gravity>()->acceleration.y() * scene.model.particles.mass.sum() / (columns * d * d)};
}

/// Leapfrog that refuses steps longer than `step`, like Bullet's world with clamped speeds.
inline Method refusing_above(double step) {
  Method method = find_method("leapfrog");
  method.engine = [inner = method.engine, step](const Scene& scene, const crosscheck::Run& run, Observer& observer) {
    if (time_grid(run).h > step) throw Unsupported("too long");
    return inner(scene, run, observer);
  };
  return method;
}

}  // namespace crosscheck::testing_tools
