#include "Vector3f.h"
