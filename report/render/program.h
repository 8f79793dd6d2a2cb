// One compiled shader program and its uniforms by name.
#pragma once

#include <Eigen/Core>
#include <string>

#include "report/render/gl.h"

namespace crosscheck::render {

/// Lives as long as the context. Throws std::runtime_error with the compiler's words.
class Program {
 public:
  /// `defines` are names put before the text as #define: they choose material and path at compile time.
  Program(const Gl& gl, const std::string& defines);
  void use() const { gl_.UseProgram(id_); }

  // of the program in use; a name the compiler has optimised away is ignored
  void set(const char* name, int value) const { gl_.Uniform1i(at(name), value); }
  void set(const char* name, float value) const { gl_.Uniform1f(at(name), value); }
  void set(const char* name, const Eigen::Vector3f& v) const { gl_.Uniform3f(at(name), v.x(), v.y(), v.z()); }
  void set(const char* name, const Eigen::Vector4f& v) const { gl_.Uniform4f(at(name), v.x(), v.y(), v.z(), v.w()); }
  void set(const char* name, const Eigen::Matrix4f& m) const { gl_.UniformMatrix4fv(at(name), 1, GL_FALSE, m.data()); }

 private:
  GLint at(const char* name) const { return gl_.GetUniformLocation(id_, name); }
  const Gl& gl_;
  GLuint id_ = 0;
};

}  // namespace crosscheck::render
