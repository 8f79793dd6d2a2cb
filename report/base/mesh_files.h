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

/// Writes FOLDER/frame-0001.obj (or .ply) and so on, from the start on, each particle one vertex in every frame. Throws
/// InputError where the form is another or a file cannot be written.
class MeshWriter : public Observer {
 public:
  MeshWriter(std::filesystem::path folder, const Scene& scene, const std::string& form);
  Verdict observe(const State& state, bool sample) override;
  int frames() const { return frames_; }

 private:
  std::filesystem::path folder_;
  Shape shape_;
  std::string form_;
  int frames_ = 0;
};

}  // namespace crosscheck
