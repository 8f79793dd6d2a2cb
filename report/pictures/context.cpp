// The off-screen context: OSMesa if the build found it, otherwise EGL's surfaceless platform (Mesa removed OSMesa in
// version 25.1).
#include "report/pictures/gl.h"

#ifdef CROSSCHECK_WITH_OSMesa
#include <GL/osmesa.h>
#else
#include <EGL/egl.h>
#include <EGL/eglext.h>
#endif

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace crosscheck::render {

#ifdef CROSSCHECK_WITH_OSMesa

struct Context::Handle {
  OSMesaContext context = nullptr;
  std::array<unsigned char, 16 * 16 * 4> pixels{};  // OSMesa requires a buffer, although drawing uses other buffers
  Handle() {
    const int attributes[] = {
        OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 3, 0};
    context = OSMesaCreateContextAttribs(attributes, nullptr);
  }
  ~Handle() {
    if (!context) return;
    if (OSMesaGetCurrentContext() == context) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context);
  }
  bool make_current() { return context && OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, 16, 16); }
};

#else

struct Context::Handle {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  Handle() {
    setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);  // pictures must not depend on the graphics card
    display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) return;
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  }
  ~Handle() {
    // do not terminate the display, because other contexts of the process may use it
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
  bool make_current() {
    return context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }
};

#endif

Context::Context() {
  // otherwise Mesa would write compiled shaders into the home folder
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  handle_ = std::make_unique<Handle>();
  if (!handle_->make_current()) throw std::runtime_error("Mesa gives no current OpenGL 3.3 core context");
  // fail early: a libGL linked in addition to OSMesa would silently ignore every call
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = name ? name : "nothing";
  if (!renderer.starts_with("llvmpipe") && !renderer.starts_with("softpipe"))
    throw std::runtime_error("Mesa's software renderer does not answer (GL_RENDERER: " + renderer + ")");
}

Context::~Context() = default;

}  // namespace crosscheck::render
