// glad, whose loader always succeeds because there is nothing to load.
#pragma once

#include "../GL/gl.h"

using GLADloadproc = void* (*)(const char*);
CLASSIC_NOTHING(gladLoadGL)
CLASSIC_NOTHING(gladLoadGLLoader)
