// A drawn image with its letters, set by gnuplot in a private folder.
#pragma once

#include <filesystem>
#include <vector>

#include "report/render/layout.h"
#include "report/render/letter_page.h"

namespace crosscheck::render {

/// The colours of the picture's bar, if it has one, straight from the map that also colours the bodies.
void paint_bar(const Picture& picture, const Layout& layout, Image& image);

/// Writes the image with the picture's letters to the file. `what` names it in the messages of the
/// std::runtime_error that is thrown where gnuplot is missing or fails (a warning is none).
void write_lettered(const Picture& picture, const Layout& layout, const Image& image, const Paper& paper,
                    const std::string& what, const std::filesystem::path& file);

/// The same as an image.
Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// The image that a script (lettering.h) draws; it writes "picture.png".
Image drawn_letters(const std::string& script);

}  // namespace crosscheck::render
