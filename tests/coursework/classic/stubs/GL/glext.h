// No extension beyond gl.h.
#pragma once

#include "gl.h"
