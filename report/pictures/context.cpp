// The only file that knows OSMesa: creates, checks and destroys the off-screen context.
#include "report/pictures/context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace crosscheck::render {

struct Context::Handle {
  OSMesaContext context = nullptr;
  std::array<unsigned char, 16 * 16 * 4> pixels{};  // OSMesa wants a buffer; all drawing goes to own framebuffers
  ~Handle() {
    if (!context) return;
    if (OSMesaGetCurrentContext() == context) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context);
  }
};

Context::Context() : handle_(std::make_unique<Handle>()) {
  // without this Mesa writes compiled shaders into the home folder
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);

  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  handle_->context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!handle_->context) throw std::runtime_error("OSMesa gives no OpenGL 3.3 core context");
  make_current();
  gl_ = load_gl([](const char* name) { return reinterpret_cast<GlAddress>(OSMesaGetProcAddress(name)); });

  // a libGL linked next to OSMesa would swallow every call in silence
  const auto* name = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
  const std::string renderer = name ? name : "nothing";
  if (renderer.rfind("llvmpipe", 0) != 0 && renderer.rfind("softpipe", 0) != 0) {
    throw std::runtime_error("OSMesa's software renderer does not answer (GL_RENDERER: " + renderer + ")");
  }
}

Context::~Context() = default;

void Context::make_current() const {
  if (!OSMesaMakeCurrent(handle_->context, handle_->pixels.data(), GL_UNSIGNED_BYTE, 16, 16)) {
    throw std::runtime_error("OSMesa cannot make its context current");
  }
}

}  // namespace crosscheck::render
