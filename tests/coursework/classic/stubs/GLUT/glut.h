// The header's path on macOS.
#pragma once

#include "../GL/glut.h"
