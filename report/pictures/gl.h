// The part of OpenGL 3.3 that the renderer uses: off-screen context, shaders, framebuffers, triangles.
#pragma once

#include <GL/glcorearb.h>
#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace crosscheck::render {

/// Makes an OpenGL 3.3 core context of Mesa's software renderer current in this thread, and deletes all OpenGL objects
/// made in its lifetime. Throws std::runtime_error if there is no such context.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

// The objects below live as long as the context in which they are made.

class Program {
 public:
  /// Compiles shaders.glsl with these #defines (separated by spaces), which select material and stage. Throws
  /// std::runtime_error with the compiler's messages.
  explicit Program(const std::string& defines);
  void use() const { glUseProgram(id_); }

  // set uniforms of the program in use; names that the compiler optimised away are ignored
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, float value) const { glUniform1f(at(name), value); }
  void set(const char* name, const Eigen::Vector3f& v) const { glUniform3f(at(name), v.x(), v.y(), v.z()); }
  void set(const char* name, const Eigen::Vector4f& v) const { glUniform4f(at(name), v.x(), v.y(), v.z(), v.w()); }
  void set(const char* name, const Eigen::Matrix4f& m) const { glUniformMatrix4fv(at(name), 1, GL_FALSE, m.data()); }

 private:
  GLint at(const char* name) const { return glGetUniformLocation(id_, name); }
  GLuint id_;
};

/// A framebuffer with one texture of RGBA floats, and optionally a depth buffer.
struct Target {
  GLuint framebuffer = 0, texture = 0;
};
Target colour_target(int width, int height, GLint format, bool with_depth);

/// A square depth texture that compares depths when it is sampled; everything outside it is lit.
Target shadow_map(int texels);

/// Data of corners or instances: rows of `stride` bytes whose columns are vertex attributes.
struct VertexRows {
  struct Column {
    GLuint location;
    GLint floats;
    std::size_t offset;  // bytes
  };
  const void* data;
  std::size_t count, stride;
  std::vector<Column> columns;
};

/// Triangles that are drawn by one call, once or once per instance. Must be destroyed before the context.
class Batch {
 public:
  Batch(const std::vector<unsigned>& index, const VertexRows& corners, const std::optional<VertexRows>& instances = {});
  ~Batch();
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  bool empty() const { return instances_ == 0 || corners_ == 0; }
  void draw() const;

 private:
  void upload(GLenum kind, const void* data, std::size_t bytes);
  void add(const VertexRows& rows, GLuint divisor);

  GLuint array_ = 0;
  std::vector<GLuint> buffers_;
  GLsizei corners_, instances_;
};

}  // namespace crosscheck::render
