// Drawing is in gl.h.
#include "gl.h"
