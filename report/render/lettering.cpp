// Writes labels, swatches and the colour bar as gnuplot commands at places given in pixels.
#include "report/render/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/render/colour.h"
#include "report/render/text_width.h"

namespace crosscheck::render {
namespace {

/// Collects commands; places are pixels from the top left, gnuplot's are parts of the picture from the bottom left.
class Script {
 public:
  Script(int width, int height) : width_(width), height_(height) {}

  void line(const std::string& command) { text_ += command + "\n"; }

  /// Text with its middle at height y; `side` is left, center or right. Sizes in pixels: the terminal has 96 per inch.
  void label(double x, double y, const char* side, const std::string& text, double size, bool bold, unsigned colour) {
    if (text.empty()) return;
    line(fmt::format("set label {} at {} {} noenhanced front font 'DejaVu Sans{},{:.2f}' textcolor rgb '#{:06X}'",
                     quoted(text), at(x, y), side, bold ? ":Bold" : "", 0.75 * size, colour));
  }

  void box(double left, double top, double right, double bottom, unsigned colour) {
    line(fmt::format("set object rectangle from {} to {} front fillcolor rgb '#{:06X}' fillstyle solid noborder",
                     at(left, bottom), at(right, top), colour));
  }

  void stroke(double x0, double y0, double x1, double y1, unsigned colour, double width) {
    line(fmt::format("set arrow from {} to {} nohead front linecolor rgb '#{:06X}' linewidth {:.2f}", at(x0, y0),
                     at(x1, y1), colour, width));
  }

  const std::string& text() const { return text_; }

 private:
  std::string at(double x, double y) const {
    return fmt::format("screen {:.6f}, screen {:.6f}", x / width_, 1 - y / height_);
  }

  /// In single quotes nothing is special to gnuplot but the quote itself.
  static std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) {
      const bool control = static_cast<unsigned char>(letter) < 32;
      result += control ? std::string(" ") : letter == '\'' ? std::string("''") : std::string(1, letter);
    }
    return result + "'";
  }

  int width_, height_;
  std::string text_;
};

constexpr unsigned title_ink = 0x111111, ink = 0x333333, subtitle_ink = 0x666666, note_ink = 0x9A1F2E;

void add_titles(Script& script, const Picture& picture, const Layout& layout) {
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const auto& row = picture.rows[r];
    for (std::size_t c = 0; c < row.size(); ++c) {
      const double left = layout.left + double(c) * layout.panel_width, middle = left + 0.5 * layout.panel_width;
      if (is_strip(row) && c == 0) {
        script.label(left + 0.8 * layout.text, layout.title_y[r], "left", row[c].title, layout.title, true, title_ink);
      } else {
        script.label(middle, layout.title_y[r], "center", row[c].title, layout.title, true, title_ink);
      }
      script.label(middle, layout.subtitle_y[r], "center", row[c].subtitle, layout.subtitle, false, subtitle_ink);
      const double foot = layout.panel_top[r] + layout.panel_height - 1.1 * layout.text;
      const double note =
          std::min(layout.text, 0.94 * layout.panel_width / std::max(text_width(row[c].note, false), 1.0));
      script.label(middle, foot, "center", row[c].note, note, false, note_ink);
    }
  }
}

void add_legend(Script& script, const Picture& picture, const Layout& layout) {
  const double font = layout.text;
  for (std::size_t l = 0; l < layout.legend.size(); ++l) {
    double width = 0;
    for (const int i : layout.legend[l]) width += legend_entry_width(picture.legend[std::size_t(i)], font);
    double x = 0.5 * (picture.width - width) + 0.6 * font;
    const double y = layout.legend_y + 1.7 * font * double(l);
    for (const int i : layout.legend[l]) {
      const std::string& name = picture.legend[std::size_t(i)];
      script.box(x, y - 0.28 * font, x + 1.5 * font, y + 0.28 * font, palette_hex(i));
      script.label(x + 2.0 * font, y, "left", name, font, false, ink);
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

void add_bar(Script& script, const Scale& scale, const Layout& layout) {
  const double font = layout.text, top = layout.bar_top, bottom = top + layout.bar_height;
  const double left = layout.bar_left, right = left + layout.bar_width;
  // edges drawn once around the bar, whose colours are in the pixels
  for (const double y : {top, bottom}) script.stroke(left, y, right, y, 0x777777, 0.8);
  for (const double x : {left, right}) script.stroke(x, top, x, bottom, 0x777777, 0.8);
  script.label((left + right) / 2, bottom + 2.25 * font, "center", scale.label, font, false, title_ink);

  const double span = scale.high - scale.low;
  if (!(span > 0) || !std::isfinite(span)) return;
  const double step = tick_step(span);
  for (double i = std::ceil(scale.low / step - 1e-6); i * step <= scale.high + 1e-6 * span; ++i) {
    const double x = left + layout.bar_width * std::clamp((i * step - scale.low) / span, 0.0, 1.0);
    script.stroke(x, bottom, x, bottom + 0.3 * font, 0x777777, 0.8);
    script.label(x, bottom + 0.95 * font, "center", number(i * step, step), 0.92 * font, false, ink);
  }
}

}  // namespace

std::string lettering_script(const Picture& picture, const Layout& layout, const std::string& pixels,
                             const std::string& output) {
  const int width = picture.width, height = picture.height;
  Script script(width, height);
  script.line("set encoding utf8");
  script.line(fmt::format("set terminal pngcairo size {},{} font 'DejaVu Sans,10' background rgb '#{:06X}'", width,
                          height, background_hex));
  script.line(fmt::format("set output '{}'", output));
  script.line("set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1");
  script.line("unset border; unset tics; unset key");
  script.line(fmt::format("set xrange [-0.5:{}]; set yrange [{}:-0.5]", width - 0.5, height - 0.5));
  add_titles(script, picture, layout);
  add_legend(script, picture, layout);
  if (picture.scale) add_bar(script, *picture.scale, layout);
  script.line(
      fmt::format("plot '{}' binary array=({},{}) format='%uchar' using 1:2:3 with rgbimage", pixels, width, height));
  return script.text();
}

}  // namespace crosscheck::render
