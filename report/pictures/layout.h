// Positions of panels, titles, colour bar and legend in the picture, in pixels from the top left, and widths of texts.
#pragma once

#include <string>
#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Width of a text in DejaVu Sans (or its bold), in units of the font size; defined in lettering.cpp.
double text_width(const std::string& text, bool bold);

inline constexpr double line_height = 1.25;  // distance between the lines of a text, in units of the font size

/// Breaks lines that are wider than the room (in units of the font size): after a slash, after a comma with its space,
/// or before a plus.
std::string wrapped(const std::string& text, bool bold, double room);

struct Layout {
  double title = 0, text = 0;  // font sizes, pixels
  double subtitle = 0;         // font size of the subtitles, pixels
  int panel_width = 0, panel_height = 0;
  int left = 0;                    // edge of the first column
  std::vector<int> panel_top;      // one per row
  std::vector<double> title_y;     // centre of the title's last line, one per row
  std::vector<double> subtitle_y;  // centre of the subtitle's first line, one per row
  double legend = 0;               // font size of the legend, pixels
  double legend_width = 0;         // in units of that size
  double legend_y = 0;             // centre of its line
  double bar_top = 0, bar_height = 0, bar_left = 0, bar_width = 0;
};

/// True for a row with a single title, in its first column: a strip, in which the title heads the whole row.
bool is_strip(const std::vector<Panel>& row);

/// Width of a legend entry with its swatch and the gap after it, in units of the font size.
double legend_entry_width(const std::string& name);

/// Throws std::runtime_error if the picture has no panels, InputError if its size leaves no room for them.
Layout layout_of(const Picture& picture);

}  // namespace crosscheck::render
