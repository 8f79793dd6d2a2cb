// Letters, boxes and lines as gnuplot commands, at places in pixels from the top left of a page.
#pragma once

#include <string>

namespace crosscheck::render {

/// What gnuplot writes: a PNG of these pixels, or a PDF page on which so many of them make an inch.
struct Paper {
  bool pdf = false;
  double pixels_per_inch = 96;  // gnuplot's own for PNG: letters of 0.75 pt are a pixel high
};

class LetterPage {
 public:
  LetterPage(int width, int height, const Paper& paper, const std::string& output);

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

}  // namespace crosscheck::render
