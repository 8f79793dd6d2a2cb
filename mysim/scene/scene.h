// A scene: what is simulated, and for which question. Read from TOML once, expanded once, used by every engine.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// From where the scene is seen: only the direction from target to eye counts, the distance is chosen to hold
/// everything.
struct Camera {
  Vec3 eye, target;          // m
  std::optional<double> at;  // s, when the picture is taken; none: at the end
};

struct Scene {
  std::string name;
  std::string question;    // one sentence for a reader
  std::string parameters;  // how its parameters were chosen
  Model model;
  State start;

  double duration;     // s
  int samples;         // frames after the first; they lie at i duration / samples
  double step;         // s, default step
  double window;       // s, pointwise comparison is meant up to here (a 1e-10 m perturbation grows by less than 1e3)
  double tolerance;    // m, what differs by less is the same to this scene's purpose
  std::string method;  // default method

  std::vector<std::array<int, 3>> triangles;  // surface of grids, for pictures
  std::optional<Camera> camera;               // none: chosen so that everything is seen

  std::string source;  // the TOML that it was read from; a scene changed in memory keeps it
  std::string hash;    // 16 hexadecimal digits, of everything that engines see

  // Compiled once, in scene.cpp: they instantiate the copies of every term.
  Scene() = default;
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// The scale of lengths and their round-off, m: the diagonal of the box around the start. For a single particle the
  /// distance that its speed and steady forces may carry it, but no more than the radius of the smallest sphere or
  /// the distance of two opposite planes; in a first-order scene its distance from the origin; 1 where it cannot move.
  double size() const;
};

/// Reads and expands a scene file; its name, made safe for file names, is the scene's. Throws InputError: "FILE:LINE:
/// KEY: expected ...".
Scene read_scene(const std::string& file);
/// The same from text; messages name the file.
Scene parse_scene(std::string_view text, const std::string& file, const std::string& name);
/// The same from text that has no file: the scene's name stands for it in messages.
inline Scene parse_scene(std::string_view text, const std::string& name) { return parse_scene(text, name, name); }

/// Fingerprint of particles, springs, terms and start (FNV-1a over their exact bits).
std::string hash_of(const Scene& scene);

}  // namespace crosscheck
