// A scene: the problem to simulate, and the question that it answers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// Viewpoint: only the direction from target to eye matters; the distance is chosen so that everything is visible.
struct Camera {
  Vec3 eye, target;          // m
  std::optional<double> at;  // s, time of the picture; default: the end
};

struct Scene {
  std::string name;
  std::string question;    // one sentence
  std::string parameters;  // explanation of the chosen parameters
  Model model;
  State start;

  double duration;     // s
  int samples;         // frames after the first, at i duration / samples
  double step;         // s, default
  double window;       // s, end of the pointwise comparison (by then a 1e-10 m perturbation grows less than 1000-fold)
  double tolerance;    // m, smaller differences are irrelevant to the scene's purpose
  std::string method;  // default method

  std::vector<std::array<int, 3>> triangles;  // surface of grids, for pictures
  std::optional<Camera> camera;               // default: everything is visible

  std::string source;  // its TOML text; not updated when the scene is changed in memory
  std::string hash;    // 16 hexadecimal digits, over everything that affects engines

  // Defined in scene.cpp, so that the copies of all terms are instantiated once.
  Scene() = default;
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Length scale of the scene and of its round-off (m): diagonal of the initial bounding box. A single particle has no
  /// extent; its scale is the way that speed and steady forces may carry it, at most the smallest sphere's radius and
  /// the distance of opposite planes, or, in a first-order scene, its distance from the origin. 1 if it cannot move.
  double size() const;
};

/// Reads a scene file. The scene is named after the file, with characters unsafe in file names replaced. Throws
/// InputError: "FILE:LINE: KEY: expected ...".
Scene read_scene(const std::string& file);
/// Parses the text of a scene file; messages name `file`.
Scene parse_scene(std::string_view text, const std::string& file, const std::string& name);
/// Parses a text without a file; messages name the scene.
inline Scene parse_scene(std::string_view text, const std::string& name) { return parse_scene(text, name, name); }

/// FNV-1a over the exact bits of particles, springs, terms and initial state.
std::string hash_of(const Scene& scene);

}  // namespace crosscheck
