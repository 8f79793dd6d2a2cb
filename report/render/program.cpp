// Compiles and links the shader text for one material and path.
#include "report/render/program.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "report/render/lights.h"
#include "report/render/shader_text.h"

namespace crosscheck::render {
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

}  // namespace crosscheck::render
