// Titles, legend and colour bar of a drawn image, and its PDF page, with Cairo.
#pragma once

#include <string>

#include "report/pictures/layout.h"

namespace crosscheck::render {

/// The image with the picture's text drawn on it.
Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// The bytes of a PDF page with this resolution: the image, with text as text.
std::string pdf_page(const Picture& picture, const Layout& layout, const Image& image, double pixels_per_inch);

}  // namespace crosscheck::render
