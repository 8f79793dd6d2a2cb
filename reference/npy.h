// NumPy's .npy files: what trajectories are stored in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// What stands before frames x particles x 3 numbers, float64, little endian, C order (format 1.0): 128 bytes, whatever
/// the numbers.
std::string npy_header(long frames, long particles);
/// The numbers of a frame as they stand behind it.
std::string_view npy_data(const Points& frame);
/// A whole file.
std::string npy_bytes(const std::vector<Points>& frames);

/// Reads frames x particles x 3 numbers: float64 or float32, little endian, C order, format 1.0 or 2.0. Throws
/// InputError that names the file and what was expected when it is something else, or has another number of particles,
/// or fewer than least_frames or more than most_frames frames, or is shorter or longer than its header says.
std::vector<Points> read_npy(const std::filesystem::path& file, int least_frames, int most_frames, int particles);

}  // namespace crosscheck
