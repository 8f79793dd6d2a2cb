// Header-only vectors, matrices and quaternions in single precision, written for the grader, with the names that
// submissions use.
#pragma once

#include "Vector2f.h"
#include "Vector3f.h"
#include "Vector4f.h"
// matrices need the vectors, quaternions need both
#include "Matrix2f.h"
#include "Matrix3f.h"
#include "Matrix4f.h"
#include "Quat4f.h"
