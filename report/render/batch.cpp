// Uploads corners and instances; the index buffer belongs to the vertex array bound while it is made.
#include "report/render/batch.h"

#include <cstddef>

namespace crosscheck::render {

Batch::Batch(const Gl& gl, const std::vector<ClothCorner>& cloth, const std::vector<unsigned>& index) : gl_(gl) {
  begin(index);
  upload(GL_ARRAY_BUFFER, cloth.data(), cloth.size() * sizeof(ClothCorner));
  attribute(0, 3, sizeof(ClothCorner), offsetof(ClothCorner, x), false);
  attribute(1, 3, sizeof(ClothCorner), offsetof(ClothCorner, normal), false);
  attribute(2, 3, sizeof(ClothCorner), offsetof(ClothCorner, rim), false);
  attribute(3, 2, sizeof(ClothCorner), offsetof(ClothCorner, value), false);
  instances_ = 1;
}

Batch::Batch(const Gl& gl, const Mesh& mesh, const std::vector<Sphere>& spheres) : gl_(gl) {
  upload_mesh(mesh);
  upload(GL_ARRAY_BUFFER, spheres.data(), spheres.size() * sizeof(Sphere));
  attribute(1, 4, sizeof(Sphere), offsetof(Sphere, centre), true);
  attribute(2, 3, sizeof(Sphere), offsetof(Sphere, colour), true);
  instances_ = GLsizei(spheres.size());
}

Batch::Batch(const Gl& gl, const Mesh& mesh, const std::vector<Rod>& rods) : gl_(gl) {
  upload_mesh(mesh);
  upload(GL_ARRAY_BUFFER, rods.data(), rods.size() * sizeof(Rod));
  attribute(1, 4, sizeof(Rod), offsetof(Rod, a), true);
  attribute(2, 3, sizeof(Rod), offsetof(Rod, b), true);
  attribute(3, 3, sizeof(Rod), offsetof(Rod, colour), true);
  instances_ = GLsizei(rods.size());
}

Batch::~Batch() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(GLsizei(buffers_.size()), buffers_.data());
}

void Batch::draw() const {
  if (empty()) return;
  gl_.BindVertexArray(array_);
  gl_.DrawElementsInstanced(GL_TRIANGLES, corners_, GL_UNSIGNED_INT, nullptr, instances_);
}

void Batch::upload(GLenum kind, const void* data, std::size_t bytes) {
  GLuint buffer = 0;
  gl_.GenBuffers(1, &buffer);
  buffers_.push_back(buffer);
  gl_.BindBuffer(kind, buffer);
  gl_.BufferData(kind, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
}

void Batch::begin(const std::vector<unsigned>& index) {
  gl_.GenVertexArrays(1, &array_);
  gl_.BindVertexArray(array_);
  upload(GL_ELEMENT_ARRAY_BUFFER, index.data(), index.size() * sizeof(unsigned));
  corners_ = GLsizei(index.size());
}

void Batch::upload_mesh(const Mesh& mesh) {
  begin(mesh.index);
  upload(GL_ARRAY_BUFFER, mesh.corner.data(), mesh.corner.size() * sizeof(Eigen::Vector4f));
  attribute(0, 4, sizeof(Eigen::Vector4f), 0, false);
}

void Batch::attribute(GLuint index, GLint numbers, std::size_t stride, std::size_t offset, bool per_instance) {
  gl_.EnableVertexAttribArray(index);
  gl_.VertexAttribPointer(index, numbers, GL_FLOAT, GL_FALSE, GLsizei(stride), reinterpret_cast<const void*>(offset));
  gl_.VertexAttribDivisor(index, per_instance ? 1 : 0);
}

}  // namespace crosscheck::render
