// Alias of GLUT (glut.h).
#pragma once

#include "glut.h"
