// Labels, swatches and the colour bar as gnuplot commands at places given in pixels.
#include "report/pictures/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "mysim/base/files.h"
#include "report/base/gnuplot.h"
#include "report/pictures/colour.h"
#include "report/pictures/layout.h"
#include "report/pictures/png_file.h"

namespace crosscheck::render {
namespace {

/// Letters, boxes and lines as gnuplot commands, at places in pixels from the top left of a page.
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

GnuplotPage::GnuplotPage(int width, int height, const PageFormat& paper, const std::string& output)
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

void GnuplotPage::label(double x, double y, const char* side, const std::string& text, double size, bool bold,
                        unsigned colour) {
  if (text.empty()) return;
  for (const std::string& words : lines_of(text)) {
    line(fmt::format("set label {} at {} {} noenhanced front font 'DejaVu Sans{},{:.2f}' textcolor rgb '#{:06X}'",
                     single_quoted(words), at(x, y), side, bold ? ":Bold" : "", points_ * size, colour));
    y += line_height * size;
  }
}

void GnuplotPage::box(double left, double top, double right, double bottom, unsigned colour) {
  line(fmt::format("set object rectangle from {} to {} front fillcolor rgb '#{:06X}' fillstyle solid noborder",
                   at(left, bottom), at(right, top), colour));
}

void GnuplotPage::stroke(double x0, double y0, double x1, double y1, unsigned colour, double width) {
  line(fmt::format("set arrow from {} to {} nohead front linecolor rgb '#{:06X}' linewidth {:.2f}", at(x0, y0),
                   at(x1, y1), colour, width));
}

void GnuplotPage::finish(const std::string& pixels) {
  if (pixels.empty())
    line("plot NaN");
  else
    line(fmt::format("plot '{}' binary array=({},{}) format='%uchar' using 1:2:3 with rgbimage", pixels, width_,
                     height_));
}

std::string GnuplotPage::at(double x, double y) const {
  return fmt::format("screen {:.6f}, screen {:.6f}", x / width_, 1 - y / height_);
}

constexpr unsigned title_ink = 0x111111, ink = 0x333333, subtitle_ink = 0x666666, note_ink = 0x9A1F2E;

double middle_of_column(const Layout& layout, std::size_t column) {
  return layout.left + (double(column) + 0.5) * layout.panel_width;
}

void add_titles(GnuplotPage& page, const Picture& picture, const Layout& layout) {
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const auto& row = picture.rows[r];
    for (std::size_t c = 0; c < row.size(); ++c) {
      const double middle = middle_of_column(layout, c), left = middle - 0.5 * layout.panel_width;
      const double above = line_height * layout.title * double(lines_of(row[c].title).size() - 1);
      const double y = layout.title_y[r] - above;
      if (is_strip(row) && c == 0) {
        page.label(left + 0.8 * layout.text, y, "left", row[c].title, layout.title, true, title_ink);
      } else {
        page.label(middle, y, "center", row[c].title, layout.title, true, title_ink);
      }
      page.label(middle, layout.subtitle_y[r], "center", row[c].subtitle, layout.subtitle, false, subtitle_ink);
      const double foot = layout.panel_top[r] + layout.panel_height - 1.1 * layout.text;
      const double note =
          std::min(layout.text, 0.94 * layout.panel_width / std::max(text_width(row[c].note, false), 1.0));
      page.label(middle, foot, "center", row[c].note, note, false, note_ink);
    }
  }
}

void add_legend(GnuplotPage& page, const Picture& picture, const Layout& layout) {
  const double font = layout.text;
  for (std::size_t l = 0; l < layout.legend.size(); ++l) {
    double width = 0;
    for (const int i : layout.legend[l]) width += legend_entry_width(picture.legend[std::size_t(i)], font);
    double x = 0.5 * (picture.width - width) + 0.6 * font;
    const double y = layout.legend_y + 1.7 * font * double(l);
    for (const int i : layout.legend[l]) {
      const std::string& name = picture.legend[std::size_t(i)];
      page.box(x, y - 0.28 * font, x + 1.5 * font, y + 0.28 * font, palette_hex(i));
      page.label(x + 2.0 * font, y, "left", name, font, false, ink);
      x += legend_entry_width(name, font);
    }
  }
}

/// A step of 1, 2 or 5 times a power of ten that gives about five intervals.
double tick_step(double span) {
  const double rough = span / 5, power = std::pow(10, std::floor(std::log10(rough)));
  const double ratio = rough / power;
  return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

std::string number(double value, double step) {
  if (std::abs(value) < 1e-9 * step) value = 0;
  std::string text = fmt::format("{:.6g}", value);
  if (text[0] == '-') text.replace(0, 1, "\u2212");
  return text;
}

void add_bar(GnuplotPage& page, const Scale& scale, const Layout& layout) {
  const double font = layout.text, top = layout.bar_top, bottom = top + layout.bar_height;
  const double left = layout.bar_left, right = left + layout.bar_width;
  // edges drawn once around the bar, which has its colours in the pixels
  for (const double y : {top, bottom}) page.stroke(left, y, right, y, 0x777777, 0.8);
  for (const double x : {left, right}) page.stroke(x, top, x, bottom, 0x777777, 0.8);
  page.label((left + right) / 2, bottom + 2.25 * font, "center", scale.label, font, false, title_ink);

  const double span = scale.high - scale.low;
  if (!(span > 0) || !std::isfinite(span)) return;
  const double step = tick_step(span);
  for (double i = std::ceil(scale.low / step - 1e-6); i * step <= scale.high + 1e-6 * span; ++i) {
    const double x = left + layout.bar_width * std::clamp((i * step - scale.low) / span, 0.0, 1.0);
    page.stroke(x, bottom, x, bottom + 0.3 * font, 0x777777, 0.8);
    page.label(x, bottom + 0.95 * font, "center", number(i * step, step), 0.92 * font, false, ink);
  }
}

}  // namespace

std::string lettering_script(const Picture& picture, const Layout& layout, const PageFormat& paper,
                             const std::string& pixels, const std::string& output) {
  GnuplotPage page(picture.width, picture.height, paper, output);
  add_titles(page, picture, layout);
  add_legend(page, picture, layout);
  if (picture.scale) add_bar(page, *picture.scale, layout);
  page.finish(pixels);
  return page.text();
}

std::string subtitles_script(const std::vector<std::vector<std::string>>& bands, const Layout& layout, int width,
                             int height, double middle, const std::string& output) {
  GnuplotPage page(width, height * int(bands.size()), {}, output);
  for (std::size_t b = 0; b < bands.size(); ++b)
    for (std::size_t c = 0; c < bands[b].size(); ++c)
      page.label(middle_of_column(layout, c), double(b) * height + middle, "center", bands[b][c], layout.subtitle,
                 false, subtitle_ink);
  page.finish("");
  return page.text();
}

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const void* data, std::size_t bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(static_cast<const char*>(data), std::streamsize(bytes));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void draw_letters(const std::string& script, const fs::path& folder, const std::string& drawn,
                  const std::string& what) {
  write(folder / "letters.gp", script.data(), script.size());
  print_warnings(run_gnuplot("letters.gp", folder, {drawn}, what), what);
}

}  // namespace

void paint_bar(const Picture& picture, const Layout& layout, Image& image) {
  if (!picture.scale) return;
  const int left = int(layout.bar_left), right = int(layout.bar_left + layout.bar_width);
  const int top = int(layout.bar_top), bottom = int(layout.bar_top + layout.bar_height);
  for (int x = left; x < right; ++x) {
    const Colour colour = scale_colour(picture.scale->diverging, (float(x - left) + 0.5f) / float(right - left));
    for (int y = top; y < bottom; ++y) {
      unsigned char* pixel = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
      for (int channel = 0; channel < 3; ++channel)
        pixel[channel] = static_cast<unsigned char>(std::lround(255 * colour[channel]));
    }
  }
}

void write_lettered(const Picture& picture, const Layout& layout, const Image& image, const PageFormat& paper,
                    const std::string& what, const fs::path& file) {
  const TemporaryFolder folder("render");
  write(folder.path / "pixels", image.rgb.data(), image.rgb.size());
  draw_letters(lettering_script(picture, layout, paper, "pixels", "picture"), folder.path, "picture", what);
  fs::copy_file(folder.path / "picture", file, fs::copy_options::overwrite_existing);
}

Image lettered(const Picture& picture, const Layout& layout, const Image& image) {
  const TemporaryFolder folder("letters");
  const fs::path file = folder.path / "picture.png";
  write_lettered(picture, layout, image, {}, "the letters of a clip", file);
  return read_png(file);
}

Image drawn_letters(const std::string& script) {
  const TemporaryFolder folder("letters");
  draw_letters(script, folder.path, "picture.png", "the letters of a clip");
  return read_png(folder.path / "picture.png");
}

}  // namespace crosscheck::render
