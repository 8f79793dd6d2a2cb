// Loads the table of OpenGL functions by name.
#include "report/render/gl.h"

#include <stdexcept>
#include <string>

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

}  // namespace crosscheck::render
