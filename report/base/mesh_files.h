// States as mesh files: one Wavefront OBJ or Stanford PLY per sample of a run.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// Drawable elements of a scene: the triangles of its cloths, and the springs and distance constraints with at least
/// one end that is not a corner of a triangle. Indices are particle numbers.
struct Shape {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<int, int>> lines;
};
Shape shape_of(const Scene& scene);

/// Wavefront OBJ file. Coordinates are in metres, exact to the last bit. Indices count from 1, as the format requires.
std::string obj_bytes(const Points& x, const Shape& shape);
/// Stanford PLY file (binary, little endian, double precision), in which the lines of the shape are elements `edge`.
std::string ply_bytes(const Points& x, const Shape& shape);

/// Mesh of a ball around the origin: a pole, 31 rings of 64 vertices, and the other pole. Triangles are
/// counter-clockwise from outside. Edges dip below the ball by 0.12 % of its radius.
std::pair<Points, Shape> ball_mesh(double radius);

/// Writes FOLDER/frame-0001.obj (or .ply) and so on, beginning with the initial state; vertices are particles. Writes
/// sphere-1.obj for a sphere at rest, and sphere-1-0001.obj and so on (one per frame) for a moving sphere. Throws
/// InputError if `form` is neither obj nor ply, or if a file cannot be written.
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
