// GLEW: every extension is available and does nothing.
#pragma once

#include "gl.h"
#include "glu.h"

#define GLEW_OK 0
static GLboolean glewExperimental = 0;
CLASSIC_NOTHING(glewInit)
