// Cloths that the fused step accepts, combined with the other terms of a scene that it must handle.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "experiments/scenes/scenes.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck::testing_tools {

inline std::optional<simd::GridTopology> grid_topology_in(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  return springs ? simd::find_grid_topology(*springs, scene.model.particles.size()) : std::nullopt;
}

struct Cloth {
  const char* name;
  int rows, columns;
  std::string more;             // additional lines of the scene file
  void (*change)(Scene&) = {};  // modification that a scene file cannot express
};

inline Springs& springs_of(Scene& scene) {
  for (Term& term : scene.model.terms)
    if (auto* springs = std::get_if<Springs>(&term)) return *springs;
  throw std::logic_error("no springs");
}

/// A cloth with a single row. It is written spring by spring, because a grid has at least two rows.
inline std::string one_row(int columns) {
  std::string text;
  for (int i = 0; i < columns; ++i) text += fmt::format("[[particle]]\nposition = [{}, 0, 0]\nmass = 0.01\n", 0.1 * i);
  for (const int skip : {1, 2})
    for (int i = 0; i + skip < columns; ++i)
      text +=
          fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = {}\n", i, i + skip, 40 / skip, 0.1 * skip);
  return text;
}

inline std::string text_of(const Cloth& cloth, const std::string& stiffness) {
  if (cloth.rows == 1) return one_row(cloth.columns) + cloth.more;
  return fmt::format(
      "[grid]\nsize = [{}, {}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, {}]\nmass = 0.2\n"
      "[grid.stiffness]\n{}\n{}",
      cloth.columns, cloth.rows, (cloth.rows - 1) / (cloth.columns - 1.), stiffness, cloth.more);
}

/// The scene of a cloth with an initial wave, so that springs are under tension from the first step on.
inline Scene scene_of(const Cloth& cloth, const std::string& stiffness = "structural = 40\nshear = 25\nbend = 10") {
  Scene scene = small_scene(text_of(cloth, stiffness), 0.2, 1e-3, 4);
  scene.window = 0.2;
  Random random(5);
  for (int i = 0; i < scene.start.x.cols(); ++i) {
    if (scene.model.particles.pinned[i]) continue;
    scene.start.x(1, i) += 0.02 * std::sin(7 * scene.start.x(0, i) + 5 * scene.start.x(2, i));
    for (double& v : scene.start.v.col(i)) v += random.between(-0.1, 0.1);
  }
  if (cloth.change) cloth.change(scene);
  return scene;
}

inline const std::string hang = "[pins]\nparticles = [0, 1]\n" + std::string(gravity_text);

/// Cloths with sizes around the lane widths (tiles of 8 or 16), with a single row, and with other terms.
inline std::vector<Cloth> cloths() {
  return {
      {"17 columns: the fewest", 5, 17, hang},
      {"24: whole lanes", 4, 24, hang},
      {"25: one more", 6, 25, hang},
      {"one row", 1, 40, hang},
      {"two rows", 2, 33, hang},
      {"a tall one", 41, 19, hang},
      {"32: two whole tiles of floats", 6, 32, hang},
      {"33: one more", 9, 33, hang + "[drag]\ngamma = 2\n"},
      {"51", 7, 51, hang + "[drag]\ncoefficient = 1e-3\n"},
      {"no pins, no gravity", 8, 24, ""},
      {"pins in the middle and at the ends", 6, 26,
       "[pins]\nparticles = [0, 25, 60, 77, 100, 130, 155]\n" + std::string(gravity_text)},
      {"moved pins", 5, 30,
       "[pins]\nparticles = [0, 29]\n[pins.motion]\namplitude = [0.1, 0, 0.05]\nfrequency = 3\nramp = 0.1\n" +
           std::string(gravity_text)},
      {"wind that comes and goes", 6, 20,
       hang + "[wind]\nacceleration = [3, 0, 1]\n[wind.gusts]\nvariation = 0.5\nside = [0, 1, 0]\nseed = 3\n"},
      {"masses of their own", 7, 22, hang + "[drag]\ncoefficient = 1e-3\n",
       [](Scene& scene) {
         for (int i = 0; i < scene.model.particles.size(); ++i) scene.model.particles.mass[i] *= 1 + 0.5 * std::sin(i);
       }},
      {"on a ball", 12, 24,
       std::string(gravity_text) +
           "[sphere]\ncentre = [0, -0.3, 0.25]\nradius = 0.28\nmargin = 0.01\nfriction = 0.3\n"},
      {"on a ball that moves", 12, 24,
       std::string(gravity_text) + "[sphere]\ncentre = [0, -0.3, 0.25]\nradius = 0.28\nmargin = 0.01\nfriction = 0.3\n"
                                   "[sphere.motion]\namplitude = [0.1, 0, 0]\nfrequency = 2\nramp = 0.1\n"},
  };
}

inline Trajectory path_of(const std::string& method, const Scene& scene) {
  Recorder recorder;
  Run run = default_run(scene);
  run.timed = false;
  const Outcome out = run_method(find_method(method), scene, run, {&recorder});
  EXPECT_EQ(out.verdict, Verdict::ok) << method << ": " << out.reason;
  return recorder.trajectory;
}

inline constexpr const char* fused_rules[] = {"symplectic-euler", "leapfrog", "suzuki4"};

}  // namespace crosscheck::testing_tools
