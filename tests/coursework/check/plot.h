// A small plot of the student's curve over the right one.
#pragma once

#include <string>

#include "case.h"

namespace coursework {

struct PlotTexts {
  std::string right, yours;  // the legend
  std::string x, y;          // labels of the axes
};

/// An SVG of 360 x 220 pixels for embedding in a page; empty if the case draws nothing or has fewer than two rows. The
/// window is the range of the right curve, enlarged by a third. The student's curve is clipped at the window, so that
/// the right curve keeps its size.
std::string plot(const Case& what, const Numbers& got, const PlotTexts& texts);

/// The text with special characters escaped for HTML.
std::string escaped(const std::string& text);

}  // namespace coursework
