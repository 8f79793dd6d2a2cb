// A current off-screen OpenGL context for as long as the object lives.
#pragma once

#include <memory>

#include "report/pictures/gl.h"

namespace crosscheck::render {

/// Makes an OpenGL 3.3 core context of Mesa's software renderer current in this thread. All OpenGL objects made
/// meanwhile die with it. Throws std::runtime_error if there is none.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  /// To be called before drawing if another context may have been made since.
  void make_current() const;
  const Gl& gl() const { return gl_; }

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  Gl gl_;
};

}  // namespace crosscheck::render
