#include "report/pictures/gl.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "report/base/assets.h"
#include "report/pictures/camera.h"

namespace crosscheck::render {
namespace {

[[noreturn]] void fail(const std::string& defines, const char* words) {
  throw std::runtime_error("shader " + defines + ": " + words);
}

GLuint compiled(GLenum stage, const std::string& defines) {
  std::string text =
      fmt::format("#version 330 core\n#define KEY_LIGHT {:.4f}\n#define SKY_LIGHT {:.4f}\n", key_light, sky_light);
  std::istringstream names(defines + (stage == GL_VERTEX_SHADER ? " VERTEX" : " FRAGMENT"));
  for (std::string name; names >> name;) text += "#define " + name + "\n";
  text += asset("pictures/shaders.glsl");
  const GLuint id = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(id, 1, &source, nullptr);
  glCompileShader(id);
  GLint good = 0;
  glGetShaderiv(id, GL_COMPILE_STATUS, &good);
  char words[1000] = "";
  if (!good) glGetShaderInfoLog(id, sizeof words, nullptr, words), fail(defines, words);
  return id;
}

void attach_depth(int width, int height) {
  GLuint id = 0;
  glGenRenderbuffers(1, &id);
  glBindRenderbuffer(GL_RENDERBUFFER, id);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, id);
}

Target new_target(GLenum attachment, GLint format, int width, int height, GLenum kind, GLint filter) {
  Target target;
  glGenTextures(1, &target.texture);
  glBindTexture(GL_TEXTURE_2D, target.texture);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, kind, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glGenFramebuffers(1, &target.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, target.texture, 0);
  return target;
}

void check_complete() {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL refuses a framebuffer (picture too large?)");
}

}  // namespace

Program::Program(const std::string& defines) : id_(glCreateProgram()) {
  for (const GLenum stage : {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER}) {
    const GLuint shader = compiled(stage, defines);
    glAttachShader(id_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(id_);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  char words[1000] = "";
  if (!good) glGetProgramInfoLog(id_, sizeof words, nullptr, words), fail(defines, words);
}

Target colour_target(int width, int height, GLint format, bool with_depth) {
  const Target target = new_target(GL_COLOR_ATTACHMENT0, format, width, height, GL_RGBA, GL_NEAREST);
  if (with_depth) attach_depth(width, height);
  check_complete();
  return target;
}

Target shadow_map(int texels) {
  const Target target =
      new_target(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, texels, texels, GL_DEPTH_COMPONENT, GL_LINEAR);
  // the outermost texels stay empty, so that everything outside the map is lit
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glDrawBuffer(GL_NONE), glReadBuffer(GL_NONE);
  check_complete();
  return target;
}

Batch::Batch(const std::vector<unsigned>& index, const VertexRows& corners, const std::optional<VertexRows>& instances)
    : corners_(GLsizei(index.size())), instances_(instances ? GLsizei(instances->count) : 1) {
  glGenVertexArrays(1, &array_);
  glBindVertexArray(array_);
  upload(GL_ELEMENT_ARRAY_BUFFER, index.data(), index.size() * sizeof(unsigned));
  add(corners, 0);
  if (instances) add(*instances, 1);
}

Batch::~Batch() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(GLsizei(buffers_.size()), buffers_.data());
}

void Batch::draw() const {
  if (empty()) return;
  glBindVertexArray(array_);
  glDrawElementsInstanced(GL_TRIANGLES, corners_, GL_UNSIGNED_INT, nullptr, instances_);
}

void Batch::upload(GLenum kind, const void* data, std::size_t bytes) {
  buffers_.push_back(0);
  glGenBuffers(1, &buffers_.back());
  glBindBuffer(kind, buffers_.back());
  glBufferData(kind, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
}

void Batch::add(const VertexRows& rows, GLuint divisor) {
  upload(GL_ARRAY_BUFFER, rows.data, rows.count * rows.stride);
  for (const auto& [location, floats, offset] : rows.columns) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, floats, GL_FLOAT, GL_FALSE, GLsizei(rows.stride),
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(location, divisor);
  }
}

}  // namespace crosscheck::render
