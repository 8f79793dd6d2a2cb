// gnuplot's SVG made part of the page, and drawings and pictures that share their bytes.
#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.h"

namespace crosscheck {

/// The tooltips of parts of a drawing, in the order in which they are drawn.
struct Tooltips {
  std::vector<std::vector<Tooltip>> markers;  // of each element of the plot; an element may have none
  std::vector<Tooltip> boxes;                 // of all the drawing
};
/// The drawing as an <svg> element that says `alt` to screen readers: a third of its size, its curves in the reach of
/// scripts and style sheets. Coordinates of lines are rounded to a tenth of a pixel of the 680 that a figure is wide,
/// and given as differences. Titles of curves stay, so that a pointer above a curve shows its name. Throws
/// std::runtime_error where the text is no SVG of gnuplot's, or has fewer markers or boxes than there are tooltips.
std::string inline_svg(const std::string& svg, const std::string& alt, const Tooltips& tooltips = {});

/// The page with the shapes of markers, which gnuplot defines in each drawing alike, once at its beginning.
std::string deduplicate_markers(const std::string& page);

/// The page with the bytes of each picture once: where <img> elements hold the same ones, all become drawings that use
/// the first one's.
std::string deduplicate_pictures(const std::string& page);

}  // namespace crosscheck
