// As macOS spells it.
#pragma once

#include "../GL/glut.h"
