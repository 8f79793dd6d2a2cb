// Framebuffers to draw into: shadow maps and the floating-point colour buffers of a panel.
#pragma once

#include "report/render/gl.h"

namespace crosscheck::render {

// all of these live as long as the context

/// A square depth texture that compares when sampled; outside it everything is lit.
struct ShadowMap {
  ShadowMap(const Gl& gl, int texels);
  GLuint framebuffer = 0, texture = 0;
  int size;
};

/// A colour texture of RGBA floats, with a depth buffer if asked for.
struct ColourTarget {
  ColourTarget(const Gl& gl, int width, int height, GLint format, bool with_depth);
  GLuint framebuffer = 0, texture = 0;
};

/// Four samples per pixel, colour and depth; to be resolved into a ColourTarget of the same format.
struct SampledTarget {
  SampledTarget(const Gl& gl, int width, int height, GLenum format);
  GLuint framebuffer = 0;
};

}  // namespace crosscheck::render
