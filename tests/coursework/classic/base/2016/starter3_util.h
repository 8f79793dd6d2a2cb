// The same as gl.h here.
#include "gl.h"
