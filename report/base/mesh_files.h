// States as files that modellers and renderers open: one Wavefront OBJ or Stanford PLY for each sample of a run.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// What is drawn of a scene: the triangles of its cloths, and lines for springs and hard distances that have an end in
/// no triangle. Indices are those of particles.
struct Shape {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<int, int>> lines;
};
Shape shape_of(const Scene& scene);

/// Metres, with as many digits as give back the same number. Indices count from 1, as the format wants it.
std::string obj_bytes(const Points& x, const Shape& shape);
/// Binary, little endian, double precision; lines are the element `edge`.
std::string ply_bytes(const Points& x, const Shape& shape);

/// Vertices of a ball around the origin and its triangles, seen counter-clockwise from outside: a pole, 31 rings of 64
/// vertices, the other pole. Its chords dip 0.12 % of the radius below the ball.
std::pair<Points, Shape> ball_mesh(double radius);

/// Writes FOLDER/frame-0001.obj (or .ply) and so on, from the start on, each particle one vertex in every frame; of
/// each sphere sphere-1.obj and so on, and where it moves sphere-1-0001.obj beside each frame. Throws InputError where
/// the form is another or a file cannot be written.
class MeshWriter : public Observer {
 public:
  MeshWriter(std::filesystem::path folder, const Scene& scene, const std::string& form);
  Verdict observe(const State& state, bool sample) override;
  int frames() const { return frames_; }

 private:
  void write(const std::string& name, const Points& x, const Shape& shape) const;

  std::filesystem::path folder_;
  Shape shape_;
  Spheres spheres_;
  std::string form_;
  int frames_ = 0;
};

}  // namespace crosscheck
