// The helper header of the 2012 family.
#pragma once

#include "GL/glut.h"
#include "prelude.h"
