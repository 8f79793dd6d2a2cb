// Corners and instances in the graphics memory, ready for one draw call.
#pragma once

#include <vector>

#include "report/render/gl.h"
#include "report/render/mesh.h"
#include "report/render/stage.h"

namespace crosscheck::render {

/// Frees its buffers; must die before the context.
class Batch {
 public:
  Batch(const Gl& gl, const std::vector<ClothCorner>& cloth, const std::vector<unsigned>& index);
  Batch(const Gl& gl, const Mesh& mesh, const std::vector<Sphere>& spheres);
  Batch(const Gl& gl, const Mesh& mesh, const std::vector<Rod>& rods);
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
