// Divides the picture between panels and text. Fonts shrink until texts do not touch.
#include "report/pictures/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"

namespace crosscheck::render {

std::string wrapped(const std::string& text, bool bold, double room) {
  std::vector<std::string> pieces(1);
  for (const char letter : text) {
    const std::string& last = pieces.back();
    if (last.ends_with('/') || last.ends_with(", ") || (letter == '+' && !last.empty())) pieces.emplace_back();
    pieces.back() += letter;
  }
  std::string line, all;
  for (const std::string& piece : pieces) {
    if (!line.empty() && text_width(line + piece, bold) > room) {
      while (line.ends_with(' ')) line.pop_back();
      all += line + "\n", line.clear();
    }
    line += piece;
  }
  return all + line;
}

bool is_strip(const std::vector<Panel>& row) {
  if (row.size() < 2 || row[0].title.empty()) return false;
  return std::all_of(row.begin() + 1, row.end(), [](const Panel& p) { return p.title.empty(); });
}

double legend_entry_width(const std::string& name) { return text_width(name, false) + 3.4; }

namespace {

constexpr double fill = 0.92;  // fraction of the available width that a text may fill

std::size_t columns_of(const Picture& picture) {
  return picture.rows.empty()
             ? 0
             : std::ranges::max_element(picture.rows, {}, [](const auto& row) { return row.size(); })->size();
}

/// Largest number of lines of this text in the row; 0 if all are empty.
int lines_in(const std::vector<Panel>& row, std::string Panel::*text) {
  std::size_t most = 0;
  for (const Panel& p : row)
    if (!(p.*text).empty()) most = std::max(most, split(p.*text, '\n').size());
  return int(most);
}

double height_of(int lines, double first, double font) { return lines ? first + (lines - 1) * line_height * font : 0; }

/// Largest font size up to `wanted` with which the text is at most `room` wide.
double fitting(double wanted, const std::string& text, bool bold, double room) {
  for (const std::string& line : split(text, '\n'))
    wanted = std::min(wanted, room / std::max(text_width(line, bold), 1e-3));
  return wanted;
}

double title_line(const Layout& layout) { return 1.75 * layout.title; }
double subtitle_line(const Layout& layout) { return 1.5 * layout.text; }

/// Height of everything below the panels: legend, bar, ticks and label.
double footer_of(const Picture& picture, const Layout& layout) {
  double footer = 0;
  if (!picture.legend.empty()) footer += 2.3 * layout.text;
  if (picture.scale) footer += 4.6 * layout.text;
  return footer;
}

/// Heights of the titles above each row of panels.
std::vector<double> bands_of(const Picture& picture, const Layout& layout) {
  std::vector<double> bands;
  for (const auto& row : picture.rows) {
    const double above = bands.empty() ? 0.5 * layout.title : 0;
    bands.push_back(above + height_of(lines_in(row, &Panel::title), title_line(layout), layout.title) +
                    height_of(lines_in(row, &Panel::subtitle), subtitle_line(layout), layout.text));
  }
  return bands;
}

/// Fonts, columns and legend. They do not depend on the picture's height if the height of letters is given.
Layout columns_and_fonts(const Picture& picture) {
  const std::size_t columns = columns_of(picture);
  if (columns == 0) throw std::runtime_error("render: the picture has no panels");
  const double unit = std::sqrt(double(picture.width) * picture.height) / 960;  // 1 at 1280 x 720
  Layout layout;
  layout.title = picture.text > 0 ? picture.text : std::max(22 * unit, 8.0);
  layout.text = picture.text > 0 ? picture.text : std::max(16 * unit, 7.0);
  layout.panel_width = picture.width / int(columns);
  layout.left = (picture.width - layout.panel_width * int(columns)) / 2;
  for (const std::string& name : picture.legend) layout.legend_width += legend_entry_width(name);
  layout.legend = std::min(layout.text, fill * picture.width / std::max(layout.legend_width, 1.0));
  return layout;
}

/// True if the wrapped titles fit into panels of width `room` (in units of the font size).
bool titles_fit(const std::vector<Panel>& panels, double room) {
  return std::ranges::all_of(panels, [room](const Panel& panel) {
    return std::ranges::all_of(split(wrapped(panel.title, true, room), '\n'),
                               [&](const std::string& line) { return text_width(line, true) <= room; });
  });
}

/// Picture height (pixels) for this aspect of the panels.
int height_for(const Picture& picture, double aspect) {
  const Layout layout = columns_and_fonts(picture);
  double height = footer_of(picture, layout) + double(picture.rows.size()) * layout.panel_width / aspect;
  for (const double band : bands_of(picture, layout)) height += band;
  return int(std::ceil(height));
}

}  // namespace

Layout layout_of(const Picture& picture) {
  Layout layout = columns_and_fonts(picture);
  // the rows share the height that titles and footer leave over
  const std::vector<double> band = bands_of(picture, layout);
  double left = picture.height - footer_of(picture, layout);
  for (const double height : band) left -= height;
  layout.panel_height = int(left / double(picture.rows.size()));
  if (layout.panel_width < 16 || layout.panel_height < 16) {
    throw InputError(fmt::format("{} x {} pixels leave no room for {} x {} panels; expected a larger --size",
                                 picture.width, picture.height, columns_of(picture), picture.rows.size()));
  }

  double top = 0;
  for (std::size_t r = 0; r < picture.rows.size(); ++r) {
    const auto& row = picture.rows[r];
    const double subtitle_top =
        top + band[r] - height_of(lines_in(row, &Panel::subtitle), subtitle_line(layout), layout.text);
    layout.title_y.push_back(subtitle_top - 0.5 * title_line(layout));
    layout.subtitle_y.push_back(subtitle_top + 0.4 * subtitle_line(layout));
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

void arrange(Picture& picture, double aspect) {
  std::vector<Panel> panels = std::move(picture.rows[0]);
  const double width = fill * picture.width / picture.text;
  std::size_t columns = panels.size();
  while (columns > 1 && !titles_fit(panels, width / double(columns))) --columns;
  // spread the panels evenly over this number of rows, so that few places stay empty
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  columns = (panels.size() + rows - 1) / rows;
  picture.rows.clear();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i % columns == 0) picture.rows.emplace_back();
    panels[i].title = wrapped(panels[i].title, true, width / double(columns));
    panels[i].subtitle = wrapped(panels[i].subtitle, false, width / double(columns));
    picture.rows.back().push_back(std::move(panels[i]));
  }
  picture.height = height_for(picture, aspect);
}

}  // namespace crosscheck::render
