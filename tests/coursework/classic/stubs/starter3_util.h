// The drawing functions are in gl.h.
#include "gl.h"
