// Loads OpenGL's functions, compiles programs, makes framebuffers.
#include "report/pictures/gl.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>
#include <string>

#include "report/pictures/camera.h"
#include "report/pictures/shaders.h"

namespace crosscheck::render {

Gl load_gl(GlAddress (*address_of)(const char* name)) {
  Gl gl;
#define CROSSCHECK_GL_LOAD(type, name)                      \
  gl.name = reinterpret_cast<type>(address_of("gl" #name)); \
  if (!gl.name) throw std::runtime_error("OpenGL has no gl" #name);
  CROSSCHECK_GL_FUNCTIONS(CROSSCHECK_GL_LOAD)
#undef CROSSCHECK_GL_LOAD
  return gl;
}

namespace {

std::string shader_header(const std::string& defines) {
  std::string text =
      fmt::format("#version 330 core\n#define KEY_LIGHT {:.4f}\n#define SKY_LIGHT {:.4f}\n", key_light, sky_light);
  std::istringstream names(defines);
  for (std::string name; names >> name;) text += "#define " + name + "\n";
  return text;
}

GLuint compile(const Gl& gl, GLenum stage, const std::string& text, const std::string& defines) {
  const GLuint id = gl.CreateShader(stage);
  const char* source = text.c_str();
  gl.ShaderSource(id, 1, &source, nullptr);
  gl.CompileShader(id);
  GLint good = 0;
  gl.GetShaderiv(id, GL_COMPILE_STATUS, &good);
  if (good) return id;
  char words[1000] = "";
  gl.GetShaderInfoLog(id, sizeof words, nullptr, words);
  throw std::runtime_error("shader " + defines + ": " + words);
}

}  // namespace

Program::Program(const Gl& gl, const std::string& defines) : gl_(gl), id_(gl.CreateProgram()) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, shader_header(defines) + vertex_text(), defines);
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, shader_header(defines) + fragment_text(), defines);
  gl.AttachShader(id_, vertex), gl.AttachShader(id_, fragment);
  gl.LinkProgram(id_);
  gl.DeleteShader(vertex), gl.DeleteShader(fragment);
  GLint good = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good) return;
  char words[1000] = "";
  gl.GetProgramInfoLog(id_, sizeof words, nullptr, words);
  throw std::runtime_error("shader " + defines + ": " + words);
}

namespace {

GLuint new_framebuffer(const Gl& gl) {
  GLuint id = 0;
  gl.GenFramebuffers(1, &id);
  gl.BindFramebuffer(GL_FRAMEBUFFER, id);
  return id;
}

GLuint new_texture(const Gl& gl, GLint format, int width, int height, GLenum kind, GLint filter) {
  GLuint id = 0;
  gl.GenTextures(1, &id);
  gl.BindTexture(GL_TEXTURE_2D, id);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, kind, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return id;
}

void attach_buffer(const Gl& gl, GLenum point, GLenum format, int samples, int width, int height) {
  GLuint id = 0;
  gl.GenRenderbuffers(1, &id);
  gl.BindRenderbuffer(GL_RENDERBUFFER, id);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, id);
}

void check_complete(const Gl& gl) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("OpenGL refuses a framebuffer (picture too large?)");
  }
}

}  // namespace

ShadowMap::ShadowMap(const Gl& gl, int texels) : size(texels) {
  texture = new_texture(gl, GL_DEPTH_COMPONENT32F, size, size, GL_DEPTH_COMPONENT, GL_LINEAR);
  // nothing is ever drawn into the outermost texels: outside the map is as lit as its edge
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  framebuffer = new_framebuffer(gl);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  gl.DrawBuffer(GL_NONE), gl.ReadBuffer(GL_NONE);
  check_complete(gl);
}

ColourTarget::ColourTarget(const Gl& gl, int width, int height, GLint format, bool with_depth) {
  texture = new_texture(gl, format, width, height, GL_RGBA, GL_NEAREST);
  framebuffer = new_framebuffer(gl);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  if (with_depth) attach_buffer(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, 0, width, height);
  check_complete(gl);
}

SampledTarget::SampledTarget(const Gl& gl, int width, int height, GLenum format) {
  framebuffer = new_framebuffer(gl);
  attach_buffer(gl, GL_COLOR_ATTACHMENT0, format, 4, width, height);
  attach_buffer(gl, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, 4, width, height);
  check_complete(gl);
}

}  // namespace crosscheck::render
