// Images as files: PNG, and WebP for pages.
#pragma once

#include <filesystem>
#include <string>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Throws std::runtime_error that names the file.
Image read_png(const std::filesystem::path& file);

/// The bytes of a PNG file that says how many of its pixels make an inch, if that is given.
std::string png_bytes(const Image& image, double pixels_per_inch = 0);

/// The bytes of a lossy WebP file, half as large as a PNG of 128 colours: for small pictures on a page.
std::string webp_bytes(const Image& image);

}  // namespace crosscheck::render
