// Titles, legend, colour bar and PDF pages, with Cairo.
#pragma once

#include <string>

#include "report/pictures/layout.h"

namespace crosscheck::render {

Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// A PDF page with the image and selectable text.
std::string pdf_page(const Picture& picture, const Layout& layout, const Image& image, double pixels_per_inch);

}  // namespace crosscheck::render
