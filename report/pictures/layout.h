// Positions of panels and texts in the picture, in pixels from the top left; widths of texts.
#pragma once

#include <string>
#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Width of a text in DejaVu Sans, in units of the font size; defined in lettering.cpp.
double text_width(const std::string& text, bool bold);

inline constexpr double line_height = 1.25;  // in units of the font size

/// Breaks lines wider than `room` (in units of the font size) after a slash or a comma and its space, or before a plus.
std::string wrapped(const std::string& text, bool bold, double room);

struct Layout {
  double title = 0, text = 0;  // font sizes, pixels
  double subtitle = 0;         // font size of subtitles, pixels
  int panel_width = 0, panel_height = 0;
  int left = 0;                    // edge of the first column
  std::vector<int> panel_top;      // one per row
  std::vector<double> title_y;     // centre of the title's last line, per row
  std::vector<double> subtitle_y;  // centre of the subtitle's first line, per row
  double legend = 0;               // font size of the legend, pixels
  double legend_width = 0;         // in units of `legend`
  double legend_y = 0;             // centre of the legend's line
  double bar_top = 0, bar_height = 0, bar_left = 0, bar_width = 0;
};

/// True for a strip: a row that has only one title, which is in the first column and applies to the whole row.
bool is_strip(const std::vector<Panel>& row);

/// Width of an entry with its swatch and gap, in units of the font size.
double legend_entry_width(const std::string& name);

/// Throws std::runtime_error if the picture has no panels, and InputError if it is too small for them.
Layout layout_of(const Picture& picture);

}  // namespace crosscheck::render
