// A scene: the problem to simulate, and the question that it answers. Read from TOML once, expanded once, used by every
// engine.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// Viewpoint of a scene: only the direction from target to eye matters; the distance is chosen so that everything is
/// visible.
struct Camera {
  Vec3 eye, target;          // m
  std::optional<double> at;  // s, time of the picture; none: the end
};

struct Scene {
  std::string name;
  std::string question;    // one sentence for the reader
  std::string parameters;  // explanation of the chosen parameters
  Model model;
  State start;

  double duration;     // s
  int samples;         // number of frames after the first, at i duration / samples
  double step;         // s, default step
  double window;       // s, end of meaningful pointwise comparison (a 1e-10 m perturbation grows by less than 1e3)
  double tolerance;    // m, smaller differences are irrelevant to this scene's purpose
  std::string method;  // default method

  std::vector<std::array<int, 3>> triangles;  // surface of grids, for pictures
  std::optional<Camera> camera;               // none: chosen so that everything is visible

  std::string source;  // the TOML text it was read from; not updated when the scene is changed in memory
  std::string hash;    // 16 hexadecimal digits, over everything that affects engines

  // Defined in scene.cpp, so that the copies of all terms are instantiated only once.
  Scene() = default;
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Length scale of the scene and of its round-off (m): the diagonal of the initial bounding box. For a single
  /// particle, it is the distance that its speed and steady forces may carry it, limited by the radius of the smallest
  /// sphere and by the distance of opposite planes. In a first-order scene, it is the distance from the origin. It is 1
  /// if the particle cannot move.
  double size() const;
};

/// Reads and expands a scene file; the scene's name is the file's, made safe for file names. Throws InputError:
/// "FILE:LINE: KEY: expected ...".
Scene read_scene(const std::string& file);
/// Parses the text of a scene file; messages name `file`.
Scene parse_scene(std::string_view text, const std::string& file, const std::string& name);
/// Parses a text without a file; the scene's name replaces the file name in messages.
inline Scene parse_scene(std::string_view text, const std::string& name) { return parse_scene(text, name, name); }

/// Fingerprint of particles, springs, terms and initial state (FNV-1a over their exact bits).
std::string hash_of(const Scene& scene);

}  // namespace crosscheck
