// Titles, legend and colour bar of a drawn image, set by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/pictures/layout.h"

namespace crosscheck::render {

/// The format that gnuplot writes: a PNG of these pixels, or a PDF page on which so many of them make an inch.
struct PageFormat {
  bool pdf = false;
  double pixels_per_inch = 96;  // gnuplot's own for PNG: letters of 0.75 pt are a pixel high
};

// The gnuplot scripts that put titles, legend and colour bar on a drawn image.

/// A script that reads the raw pixels from `pixels` (or, where that is empty, none) and writes `output`; both are names
/// without quotes, in gnuplot's working folder.
std::string lettering_script(const Picture& picture, const Layout& layout, const PageFormat& paper,
                             const std::string& pixels, const std::string& output);

/// A script that writes a PNG of bands, one above the other, with the subtitles of one frame of a clip in each; sizes
/// in pixels, `middle` is where in a band its text stands.
std::string subtitles_script(const std::vector<std::vector<std::string>>& bands, const Layout& layout, int width,
                             int height, double middle, const std::string& output);

/// The colours of the picture's bar, if it has one, straight from the map that also colours the bodies.
void paint_bar(const Picture& picture, const Layout& layout, Image& image);

/// Writes the image with the picture's letters to the file. `what` names it in the messages of the
/// std::runtime_error that is thrown where gnuplot is missing or fails (a warning is none).
void write_lettered(const Picture& picture, const Layout& layout, const Image& image, const PageFormat& paper,
                    const std::string& what, const std::filesystem::path& file);

/// The same as an image.
Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// The image that such a script draws; it writes "picture.png".
Image drawn_letters(const std::string& script);

}  // namespace crosscheck::render
