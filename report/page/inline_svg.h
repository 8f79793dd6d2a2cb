// gnuplot's SVG made part of the page, and drawings and pictures that share their bytes.
#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.h"

namespace crosscheck {

// gnuplot's SVG made part of the page: a third of its size, and its curves in the reach of hands and style sheets.

/// The drawing as an <svg> element that says `alt` to screen readers. Coordinates of lines are rounded to a tenth of a
/// pixel of the 680 that a figure is wide, and given as differences. Titles of curves stay, so that a pointer above a
/// curve shows its name. Throws std::runtime_error where the text is no SVG of gnuplot's.
///
/// What parts of a drawing say to a pointer above them, in the order in which they are drawn.
struct Tooltips {
  std::vector<std::vector<Tooltip>> markers;  // of each element of the plot; an element may have none
  std::vector<Tooltip> boxes;                 // of all the drawing
};
/// Throws std::runtime_error where there are fewer markers or boxes than words.
std::string inline_svg(const std::string& svg, const std::string& alt, const Tooltips& tooltips = {});

/// The page with the shapes of markers, which gnuplot defines in each drawing alike, once at its beginning.
std::string deduplicate_markers(const std::string& page);

// Pictures that a page shows more than once.

/// The page with the bytes of each picture once: where <img> elements hold the same ones, all become drawings that use
/// the first one's.
std::string deduplicate_pictures(const std::string& page);

// Cells of maps in gnuplot's SVG, which draws each as two groups, a box and its border.

/// The drawing with each box that has a white border as a polygon alone, a third of the text: the page's style gives it
/// the border. Whatever else is in it stays. For drawings that inline_svg() has cleaned already.
void join_boxes_and_borders(std::string& body);

}  // namespace crosscheck
