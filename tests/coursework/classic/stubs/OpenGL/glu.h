// As macOS spells it.
#pragma once

#include "../GL/glu.h"
