// OpenGL 3.3 as far as the renderer uses it: its functions, shader programs and framebuffers.
#pragma once

#include <GL/glcorearb.h>
#include <Eigen/Core>

#include <string>

namespace crosscheck::render {

// The OpenGL 3.3 functions the renderer uses, as one struct of function pointers loaded by name.

// every function used, with the type of its pointer
#define CROSSCHECK_GL_FUNCTIONS(X)                                           \
  X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                   \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                     \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                         \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                               \
  X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                             \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                                       \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                               \
  X(PFNGLBLENDFUNCPROC, BlendFunc)                                           \
  X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                               \
  X(PFNGLBUFFERDATAPROC, BufferData)                                         \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                 \
  X(PFNGLCLEARPROC, Clear)                                                   \
  X(PFNGLCLEARCOLORPROC, ClearColor)                                         \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                                   \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                     \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                   \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                     \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                         \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                           \
  X(PFNGLDISABLEPROC, Disable)                                               \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                         \
  X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                         \
  X(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)                   \
  X(PFNGLENABLEPROC, Enable)                                                 \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)               \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)               \
  X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                     \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                                         \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                               \
  X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                             \
  X(PFNGLGENTEXTURESPROC, GenTextures)                                       \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                               \
  X(PFNGLGETERRORPROC, GetError)                                             \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                           \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                     \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                             \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                       \
  X(PFNGLGETSTRINGPROC, GetString)                                           \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                         \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                       \
  X(PFNGLREADBUFFERPROC, ReadBuffer)                                         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                         \
  X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample) \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                     \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                         \
  X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                   \
  X(PFNGLUNIFORM1FPROC, Uniform1f)                                           \
  X(PFNGLUNIFORM1IPROC, Uniform1i)                                           \
  X(PFNGLUNIFORM3FPROC, Uniform3f)                                           \
  X(PFNGLUNIFORM4FPROC, Uniform4f)                                           \
  X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                             \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                         \
  X(PFNGLVERTEXATTRIBDIVISORPROC, VertexAttribDivisor)                       \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                       \
  X(PFNGLVIEWPORTPROC, Viewport)

struct Gl {
#define CROSSCHECK_GL_MEMBER(type, name) type name = nullptr;
  CROSSCHECK_GL_FUNCTIONS(CROSSCHECK_GL_MEMBER)
#undef CROSSCHECK_GL_MEMBER
};

using GlAddress = void (*)();

/// Fills the table by `address_of` of each name; throws std::runtime_error naming the first one missing.
Gl load_gl(GlAddress (*address_of)(const char* name));

// One compiled shader program and its uniforms by name.

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

// Framebuffers to draw into: shadow maps and the floating-point colour buffers of a panel.

// all of these live as long as the context

/// A square depth texture that compares when sampled; outside it everything is lit.
struct ShadowMap {
  ShadowMap(const Gl& gl, int texels);
  GLuint framebuffer = 0, texture = 0;
  int size;
};

/// A colour texture of RGBA floats, with a depth buffer if requested.
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
