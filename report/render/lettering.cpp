// Writes labels, swatches and the colour bar as gnuplot commands at places given in pixels.
#include "report/render/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/render/colour.h"
#include "report/render/text_width.h"

namespace crosscheck::render {
namespace {

constexpr unsigned title_ink = 0x111111, ink = 0x333333, subtitle_ink = 0x666666, note_ink = 0x9A1F2E;

double middle_of_column(const Layout& layout, std::size_t column) {
  return layout.left + (double(column) + 0.5) * layout.panel_width;
}

void add_titles(LetterPage& page, const Picture& picture, const Layout& layout) {
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

void add_legend(LetterPage& page, const Picture& picture, const Layout& layout) {
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

void add_bar(LetterPage& page, const Scale& scale, const Layout& layout) {
  const double font = layout.text, top = layout.bar_top, bottom = top + layout.bar_height;
  const double left = layout.bar_left, right = left + layout.bar_width;
  // edges drawn once around the bar, whose colours are in the pixels
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

std::string lettering_script(const Picture& picture, const Layout& layout, const Paper& paper,
                             const std::string& pixels, const std::string& output) {
  LetterPage page(picture.width, picture.height, paper, output);
  add_titles(page, picture, layout);
  add_legend(page, picture, layout);
  if (picture.scale) add_bar(page, *picture.scale, layout);
  page.finish(pixels);
  return page.text();
}

std::string subtitles_script(const std::vector<std::vector<std::string>>& bands, const Layout& layout, int width,
                             int height, double middle, const std::string& output) {
  LetterPage page(width, height * int(bands.size()), {}, output);
  for (std::size_t b = 0; b < bands.size(); ++b)
    for (std::size_t c = 0; c < bands[b].size(); ++c)
      page.label(middle_of_column(layout, c), double(b) * height + middle, "center", bands[b][c], layout.subtitle,
                 false, subtitle_ink);
  page.finish("");
  return page.text();
}

}  // namespace crosscheck::render
