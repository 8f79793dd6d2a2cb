// Titles, legend and colour bar of a drawn image, set by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/pictures/layout.h"

namespace crosscheck::render {

// Letters, boxes and lines as gnuplot commands, at places in pixels from the top left of a page.

/// What gnuplot writes: a PNG of these pixels, or a PDF page on which so many of them make an inch.
struct PageFormat {
  bool pdf = false;
  double pixels_per_inch = 96;  // gnuplot's own for PNG: letters of 0.75 pt are a pixel high
};

class GnuplotPage {
 public:
  GnuplotPage(int width, int height, const PageFormat& paper, const std::string& output);

  void line(const std::string& command) { text_ += command + "\n"; }
  /// Text with the middle of its first line at height y, further ones (after line feeds) below; `side` is left, center
  /// or right. Size in pixels.
  void label(double x, double y, const char* side, const std::string& text, double size, bool bold, unsigned colour);
  void box(double left, double top, double right, double bottom, unsigned colour);
  void stroke(double x0, double y0, double x1, double y1, unsigned colour, double width);
  /// Ends the page: below all of it the raw pixels in this file, or nothing.
  void finish(const std::string& pixels);

  const std::string& text() const { return text_; }

 private:
  std::string at(double x, double y) const;

  int width_, height_;
  double points_;  // of a pixel
  std::string text_;
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

// A drawn image with its letters, set by gnuplot in a private folder.

/// The colours of the picture's bar, if it has one, straight from the map that also colours the bodies.
void paint_bar(const Picture& picture, const Layout& layout, Image& image);

/// Writes the image with the picture's letters to the file. `what` names it in the messages of the
/// std::runtime_error that is thrown where gnuplot is missing or fails (a warning is none).
void write_lettered(const Picture& picture, const Layout& layout, const Image& image, const PageFormat& paper,
                    const std::string& what, const std::filesystem::path& file);

/// The same as an image.
Image lettered(const Picture& picture, const Layout& layout, const Image& image);

/// The image that a script (lettering.h) draws; it writes "picture.png".
Image drawn_letters(const std::string& script);

}  // namespace crosscheck::render
