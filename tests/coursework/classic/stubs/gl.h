// Drawing in the newer version of the course: a shader program and a recorder of vertices, which do nothing.
#ifndef CLASSIC_GL_H
#define CLASSIC_GL_H

#include <GLFW/glfw3.h>
#include <vecmath.h>

struct GLProgram {
  template <class... A>
  void updateModelMatrix(A&&...) {}
  template <class... A>
  void updateViewMatrix(A&&...) {}
  template <class... A>
  void updateProjectionMatrix(A&&...) {}
  template <class... A>
  void updateMaterial(A&&...) {}
  template <class... A>
  void updateLight(A&&...) {}
  template <class... A>
  void updateCameraPos(A&&...) {}
  template <class... A>
  void updateVPMatrix(A&&...) {}
  template <class... A>
  void enableLighting(A&&...) {}
  template <class... A>
  void disableLighting(A&&...) {}
};

struct VertexRecorder {
  template <class... A>
  void record(A&&...) {}
  template <class... A>
  void record_poscolor(A&&...) {}
  template <class... A>
  void draw(A&&...) {}
  template <class... A>
  void draw_poscolor(A&&...) {}
  void clear() {}
};

CLASSIC_NOTHING(drawSphere)
CLASSIC_NOTHING(drawCylinder)
CLASSIC_NOTHING(drawQuad)

#endif
