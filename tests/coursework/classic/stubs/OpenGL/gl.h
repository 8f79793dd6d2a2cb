// The header's path on macOS.
#pragma once

#include "../GL/gl.h"
