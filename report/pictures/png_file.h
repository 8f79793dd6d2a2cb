// PNG files as gnuplot writes them: read back, with their size in print set.
#pragma once

#include <filesystem>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Throws std::runtime_error that names the file.
Image read_png(const std::filesystem::path& file);

/// Says in the file how many of its pixels make an inch (chunk pHYs). Throws std::runtime_error that names the file.
void set_resolution(const std::filesystem::path& file, double pixels_per_inch);
/// Packs the same pixels as small as zlib can: a report holds a dozen of them. Throws as set_resolution().
void pack_tightly(const std::filesystem::path& file);

/// The bytes of a PNG file with at most 128 colours, where that is smaller: what a screen shows beside text.
std::string with_few_colours(const std::filesystem::path& file);

}  // namespace crosscheck::render
