// GLU that does nothing.
#pragma once

#include "gl.h"

struct GLUquadric {};
typedef GLUquadric GLUquadricObj;
inline GLUquadric* gluNewQuadric() {
  static GLUquadric one;
  return &one;
}
template <class... A>
inline const GLubyte* gluErrorString(A&&...) {
  return reinterpret_cast<const GLubyte*>("");
}

CLASSIC_NOTHING(gluBuild2DMipmaps)
CLASSIC_NOTHING(gluCylinder)
CLASSIC_NOTHING(gluDeleteQuadric)
CLASSIC_NOTHING(gluDisk)
CLASSIC_NOTHING(gluLookAt)
CLASSIC_NOTHING(gluOrtho2D)
CLASSIC_NOTHING(gluPartialDisk)
CLASSIC_NOTHING(gluPerspective)
CLASSIC_NOTHING(gluPickMatrix)
CLASSIC_NOTHING(gluProject)
CLASSIC_NOTHING(gluQuadricDrawStyle)
CLASSIC_NOTHING(gluQuadricNormals)
CLASSIC_NOTHING(gluQuadricOrientation)
CLASSIC_NOTHING(gluQuadricTexture)
CLASSIC_NOTHING(gluSphere)
CLASSIC_NOTHING(gluUnProject)

#define GLU_POINT 131072
#define GLU_LINE 131073
#define GLU_FILL 131074
#define GLU_SILHOUETTE 131075
#define GLU_SMOOTH 131076
#define GLU_FLAT 131077
#define GLU_NONE 131078
#define GLU_OUTSIDE 131079
#define GLU_INSIDE 131080
