// gnuplot's SVG made part of the page: a third of its size, and its curves in the reach of hands and style sheets.
#pragma once

#include <string>
#include <vector>

#include "report/figure.h"

namespace crosscheck {

/// The drawing as an <svg> element that says `alt` to screen readers. Coordinates of lines are rounded to a tenth of a
/// pixel of the 680 that a figure is wide, and given as differences. Titles of curves stay, so that a pointer above a
/// curve shows its name. Throws std::runtime_error where the text is no SVG of gnuplot's.
///
/// What parts of a drawing say to a pointer above them, in the order in which they are drawn.
struct Told {
  std::vector<std::vector<Tip>> markers;  // of each element of the plot; an element may have none
  std::vector<Tip> boxes;                 // of all the drawing
};
/// Throws std::runtime_error where there are fewer markers or boxes than words.
std::string inline_svg(const std::string& svg, const std::string& alt, const Told& told = {});

/// The page with the shapes of markers, which gnuplot defines in each drawing alike, once at its beginning.
std::string sharing_markers(const std::string& page);

}  // namespace crosscheck
