// The helper header of the course of 2012.
#pragma once

#include "GL/glut.h"
#include "prelude.h"
