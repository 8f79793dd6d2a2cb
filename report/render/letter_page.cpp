// gnuplot's places are parts of the page from the bottom left.
#include "report/render/letter_page.h"

#include <fmt/format.h>

#include "report/render/colour.h"
#include "report/render/text_width.h"

namespace crosscheck::render {
namespace {

/// In single quotes nothing is special to gnuplot but the quote itself.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    const bool control = static_cast<unsigned char>(letter) < 32;
    result += control ? std::string(" ") : letter == '\'' ? std::string("''") : std::string(1, letter);
  }
  return result + "'";
}

}  // namespace

LetterPage::LetterPage(int width, int height, const Paper& paper, const std::string& output)
    : width_(width), height_(height), points_(72 / paper.pixels_per_inch) {
  line("set encoding utf8");
  const std::string look = fmt::format("font 'DejaVu Sans,10' background rgb '#{:06X}'", background_hex);
  // a scale of 0.75 makes its points of letters points of the page
  if (paper.pdf)
    line(fmt::format("set terminal pdfcairo size {:.6f}in,{:.6f}in {} fontscale 0.75 linewidth {:.4f}",
                     width / paper.pixels_per_inch, height / paper.pixels_per_inch, look, points_ / 0.75));
  else
    line(fmt::format("set terminal pngcairo size {},{} {}", width, height, look));
  line(fmt::format("set output '{}'", output));
  line("set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1");
  line("unset border; unset tics; unset key");
  line(fmt::format("set xrange [-0.5:{}]; set yrange [{}:-0.5]", width - 0.5, height - 0.5));
}

void LetterPage::label(double x, double y, const char* side, const std::string& text, double size, bool bold,
                       unsigned colour) {
  if (text.empty()) return;
  for (const std::string& words : lines_of(text)) {
    line(fmt::format("set label {} at {} {} noenhanced front font 'DejaVu Sans{},{:.2f}' textcolor rgb '#{:06X}'",
                     quoted(words), at(x, y), side, bold ? ":Bold" : "", points_ * size, colour));
    y += line_height * size;
  }
}

void LetterPage::box(double left, double top, double right, double bottom, unsigned colour) {
  line(fmt::format("set object rectangle from {} to {} front fillcolor rgb '#{:06X}' fillstyle solid noborder",
                   at(left, bottom), at(right, top), colour));
}

void LetterPage::stroke(double x0, double y0, double x1, double y1, unsigned colour, double width) {
  line(fmt::format("set arrow from {} to {} nohead front linecolor rgb '#{:06X}' linewidth {:.2f}", at(x0, y0),
                   at(x1, y1), colour, width));
}

void LetterPage::finish(const std::string& pixels) {
  if (pixels.empty())
    line("plot NaN");
  else
    line(fmt::format("plot '{}' binary array=({},{}) format='%uchar' using 1:2:3 with rgbimage", pixels, width_,
                     height_));
}

std::string LetterPage::at(double x, double y) const {
  return fmt::format("screen {:.6f}, screen {:.6f}", x / width_, 1 - y / height_);
}

}  // namespace crosscheck::render
