// The same as GLUT here.
#pragma once

#include "glut.h"
