// Sphere and rod as surfaces of revolution; vertex arrays and buffers.
#include "report/pictures/mesh.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace crosscheck::render {
namespace {

/// Rows of `around` + 1 corners joined to a skin.
void join_rows(Mesh& mesh, int rows, int around) {
  const auto at = [&](int row, int i) { return unsigned(row * (around + 1) + i); };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      for (const unsigned corner : {at(row, i), at(row, i + 1), at(row + 1, i + 1)}) mesh.index.push_back(corner);
      for (const unsigned corner : {at(row, i), at(row + 1, i + 1), at(row + 1, i)}) mesh.index.push_back(corner);
    }
  }
}

/// A circle of normals at the latitude given (-pi/2 .. pi/2), carrying `end`.
void add_row(Mesh& mesh, double latitude, int around, float end) {
  for (int i = 0; i <= around; ++i) {
    const double angle = 2 * std::numbers::pi * (i % around) / around;
    mesh.corner.emplace_back(float(std::cos(latitude) * std::cos(angle)), float(std::cos(latitude) * std::sin(angle)),
                             float(std::sin(latitude)), end);
  }
}

}  // namespace

Mesh sphere_mesh(int around) {
  Mesh mesh;
  const int stacks = around / 2;
  for (int row = 0; row <= stacks; ++row) add_row(mesh, std::numbers::pi * (double(row) / stacks - 0.5), around, 0);
  join_rows(mesh, stacks + 1, around);
  return mesh;
}

Mesh capsule_mesh(int around, int rings) {
  Mesh mesh;
  for (int end = 0; end < 2; ++end) {
    for (int ring = 0; ring <= rings; ++ring) {
      const double quarter = 0.5 * std::numbers::pi * ring / rings;
      add_row(mesh, end == 0 ? quarter - 0.5 * std::numbers::pi : quarter, around, float(end));
    }
  }
  join_rows(mesh, 2 * rings + 2, around);
  return mesh;
}

Batch::Batch(const Gl& gl, const std::vector<ClothVertex>& cloth, const std::vector<unsigned>& index) : gl_(gl) {
  begin(index);
  upload(GL_ARRAY_BUFFER, cloth.data(), cloth.size() * sizeof(ClothVertex));
  attribute(0, 3, sizeof(ClothVertex), offsetof(ClothVertex, x), false);
  attribute(1, 3, sizeof(ClothVertex), offsetof(ClothVertex, normal), false);
  attribute(2, 3, sizeof(ClothVertex), offsetof(ClothVertex, rim), false);
  attribute(3, 2, sizeof(ClothVertex), offsetof(ClothVertex, value), false);
  instances_ = 1;
}

Batch::Batch(const Gl& gl, const Mesh& mesh, const std::vector<Sphere>& spheres) : gl_(gl) {
  upload_mesh(mesh);
  upload(GL_ARRAY_BUFFER, spheres.data(), spheres.size() * sizeof(Sphere));
  attribute(1, 4, sizeof(Sphere), offsetof(Sphere, centre), true);
  attribute(2, 3, sizeof(Sphere), offsetof(Sphere, colour), true);
  instances_ = GLsizei(spheres.size());
}

Batch::Batch(const Gl& gl, const Mesh& mesh, const std::vector<Capsule>& rods) : gl_(gl) {
  upload_mesh(mesh);
  upload(GL_ARRAY_BUFFER, rods.data(), rods.size() * sizeof(Capsule));
  attribute(1, 4, sizeof(Capsule), offsetof(Capsule, a), true);
  attribute(2, 3, sizeof(Capsule), offsetof(Capsule, b), true);
  attribute(3, 3, sizeof(Capsule), offsetof(Capsule, colour), true);
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
