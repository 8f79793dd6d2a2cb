// Vectors, matrices and quaternions in single precision with the names that submissions use. Ours, header only.
#pragma once

#include "Vector2f.h"
#include "Vector3f.h"
#include "Vector4f.h"
// matrices after vectors, quaternions last
#include "Matrix2f.h"
#include "Matrix3f.h"
#include "Matrix4f.h"
#include "Quat4f.h"
