// gnuplot's SVG made part of the page: a third of its size, and its curves in the reach of hands and style sheets.
#pragma once

#include <string>
#include <vector>

namespace crosscheck {

/// The drawing as an <svg> element that says `alt` to screen readers. Coordinates of lines are rounded to a tenth of a
/// pixel of the 680 that a figure is wide, and given as differences. Titles of curves stay, so that a pointer above a
/// curve shows its name. Throws std::runtime_error where the text is no SVG of gnuplot's.
///
/// told[i]: what each marker of the plot's i-th element says to a pointer above it, in the order in which they are
/// drawn; an element may have none. Throws std::runtime_error where an element has fewer markers.
using Told = std::vector<std::vector<std::string>>;
std::string inline_svg(const std::string& svg, const std::string& alt, const Told& told = {});

/// The page with the shapes of markers, which gnuplot defines in each drawing alike, in the first one alone.
std::string sharing_markers(const std::string& page);

}  // namespace crosscheck
