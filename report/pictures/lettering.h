// Titles, legend and colour bar of a drawn image, and its PDF page, by Cairo.
#pragma once

#include <string>

#include "report/pictures/layout.h"

namespace crosscheck::render {

/// The image with the picture's letters on it.
Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// The bytes of a PDF page on which so many pixels make an inch: the image, and letters that are letters.
std::string pdf_page(const Picture& picture, const Layout& layout, const Image& image, double pixels_per_inch);

}  // namespace crosscheck::render
