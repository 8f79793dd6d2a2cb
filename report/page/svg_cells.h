// Cells of maps in gnuplot's SVG, which draws each as two groups, a box and its border.
#pragma once

#include <string>

namespace crosscheck {

/// The drawing with each box that has a white border as a polygon alone, a third of the text: the page's style gives it
/// the border. Whatever else is in it stays. For drawings that inline_svg() has cleaned already.
void join_boxes_and_borders(std::string& body);

}  // namespace crosscheck
