// NumPy's .npy files: what trajectories are stored in.
#pragma once

#include <string>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Frames x particles x 3, float64, little endian, C order (format 1.0).
std::string npy_bytes(const std::vector<Points>& frames);

}  // namespace crosscheck
