// As macOS spells it.
#pragma once

#include "../GL/gl.h"
