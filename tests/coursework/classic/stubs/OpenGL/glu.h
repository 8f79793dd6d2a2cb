// The header's path on macOS.
#pragma once

#include "../GL/glu.h"
