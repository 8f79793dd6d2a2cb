// Shares the picture out between panels and letters; fonts shrink until no text can touch its neighbour.
#include "report/render/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/render/text_width.h"

namespace crosscheck::render {
namespace {

constexpr double fill = 0.92;  // of the room that a text may take

std::size_t columns_of(const Picture& picture) {
  std::size_t columns = 0;
  for (const auto& row : picture.rows) columns = std::max(columns, row.size());
  return columns;
}

bool any(const std::vector<Panel>& row, std::string Panel::*text) {
  return std::any_of(row.begin(), row.end(), [&](const Panel& p) { return !(p.*text).empty(); });
}

/// The font size not above `wanted` with which the text fits.
double fitting(double wanted, const std::string& text, bool bold, double room) {
  const double width = text_width(text, bold);
  return width * wanted > room ? room / width : wanted;
}

std::vector<std::vector<int>> legend_lines(const Legend& legend, double font, double room) {
  std::vector<std::vector<int>> lines;
  double used = room;
  for (int i = 0; i < int(legend.size()); ++i) {
    const double width = legend_entry_width(legend[std::size_t(i)], font);
    if (used + width > room) lines.emplace_back(), used = 0;
    lines.back().push_back(i);
    used += width;
  }
  return lines;
}

}  // namespace

bool is_strip(const std::vector<Panel>& row) {
  if (row.size() < 2 || row[0].title.empty()) return false;
  return std::all_of(row.begin() + 1, row.end(), [](const Panel& p) { return p.title.empty(); });
}

double legend_entry_width(const std::string& name, double font) { return (text_width(name, false) + 3.4) * font; }

Layout layout_of(const Picture& picture) {
  const std::size_t columns = columns_of(picture);
  if (columns == 0) throw std::runtime_error("render: the picture has no panels");
  if (picture.width > 16384 || picture.height > 16384) throw std::runtime_error("render: the picture is too large");
  const double unit = std::sqrt(double(picture.width) * picture.height) / 960;  // 1 at 1280 x 720

  Layout layout;
  layout.title = std::max(22 * unit, 8.0);
  layout.text = std::max(16 * unit, 7.0);
  const double title_line = 1.75 * layout.title, subtitle_line = 1.5 * layout.text;
  layout.panel_width = picture.width / int(columns);
  layout.left = (picture.width - layout.panel_width * int(columns)) / 2;

  // below the panels: legend, then bar with its ticks and label
  layout.legend = legend_lines(picture.legend, layout.text, fill * picture.width);
  double footer = 0;
  if (!picture.legend.empty()) footer += (1.7 * double(layout.legend.size()) + 0.6) * layout.text;
  if (picture.scale) footer += 4.6 * layout.text;

  // the rows share what titles and footer leave
  std::vector<double> band;
  double bands = 0;
  for (const auto& row : picture.rows) {
    double height = band.empty() ? 0.5 * layout.title : 0;
    height += any(row, &Panel::title) ? title_line : 0;
    height += any(row, &Panel::subtitle) ? subtitle_line : 0;
    band.push_back(height);
    bands += height;
  }
  layout.panel_height = int((picture.height - footer - bands) / double(picture.rows.size()));
  if (layout.panel_width < 16 || layout.panel_height < 16) {
    throw std::runtime_error(fmt::format("render: {} x {} pixels leave no room for {} x {} panels", picture.width,
                                         picture.height, columns, picture.rows.size()));
  }

  double top = 0;
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const auto& row = picture.rows[r];
    const double subtitle_top = top + band[r] - (any(row, &Panel::subtitle) ? subtitle_line : 0);
    layout.title_y.push_back(subtitle_top - 0.5 * title_line);
    layout.subtitle_y.push_back(subtitle_top + 0.4 * subtitle_line);
    top += band[r];
    layout.panel_top.push_back(int(top));
    top += layout.panel_height;
  }
  layout.legend_y = top + 0.9 * layout.text;
  layout.bar_top = picture.height - 4.0 * layout.text;
  layout.bar_height = std::round(0.95 * layout.text);
  layout.bar_width = std::min(0.6 * picture.width, 27 * layout.text);
  layout.bar_left = (picture.width - layout.bar_width) / 2;

  layout.subtitle = layout.text;
  for (const auto& row : picture.rows) {
    for (const Panel& panel : row) {
      const double room = fill * (is_strip(row) ? picture.width : layout.panel_width);
      layout.title = fitting(layout.title, panel.title, true, room);
      layout.subtitle = fitting(layout.subtitle, panel.subtitle, false, fill * layout.panel_width);
    }
  }
  return layout;
}

double panel_aspect(const Picture& picture) {
  const Layout layout = layout_of(picture);
  return double(layout.panel_width) / layout.panel_height;
}

}  // namespace crosscheck::render
