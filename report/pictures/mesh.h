// The shapes that are drawn many times, and their corners and instances in the graphics memory.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "report/pictures/draw_list.h"
#include "report/pictures/gl.h"

namespace crosscheck::render {

// The two shapes that are drawn many times: a unit sphere and a rod with round ends.

struct Mesh {
  std::vector<Eigen::Vector4f> corner;  // sphere: unit normal, 0; rod: unit normal in the rod's axes, end (0 or 1)
  std::vector<unsigned> index;          // three per triangle, counter-clockwise from outside
};

/// A sphere of `around` slices and around / 2 stacks: its chords dip 1 - cos(pi / around) of the radius below the
/// surface.
Mesh sphere_mesh(int around);

/// A rod along its third axis with `around` sides and round ends of `rings` rings each.
Mesh capsule_mesh(int around, int rings);

// Corners and instances in the graphics memory, ready for one draw call.

/// Frees its buffers; must die before the context.
class Batch {
 public:
  Batch(const Gl& gl, const std::vector<ClothVertex>& cloth, const std::vector<unsigned>& index);
  Batch(const Gl& gl, const Mesh& mesh, const std::vector<Sphere>& spheres);
  Batch(const Gl& gl, const Mesh& mesh, const std::vector<Capsule>& rods);
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  bool empty() const { return instances_ == 0 || corners_ == 0; }
  void draw() const;

 private:
  void upload(GLenum kind, const void* data, std::size_t bytes);
  void begin(const std::vector<unsigned>& index);
  void upload_mesh(const Mesh& mesh);
  void attribute(GLuint index, GLint numbers, std::size_t stride, std::size_t offset, bool per_instance);

  const Gl& gl_;
  GLuint array_ = 0;
  std::vector<GLuint> buffers_;
  GLsizei corners_ = 0, instances_ = 0;
};

}  // namespace crosscheck::render
