// The recorder is in gl.h.
#include "gl.h"
