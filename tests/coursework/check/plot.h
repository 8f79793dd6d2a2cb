// A small plot of the student's curve on the right one. C++17, standard library only.
#pragma once

#include <string>

#include "case.h"

namespace coursework {

struct PlotTexts {
  std::string right, yours;  // the legend
  std::string x, y;          // what the axes show
};

/// An SVG of 360 x 220 pixels, to be put into a page; empty where the case draws nothing or there are fewer than two
/// rows. The window is that of the right curve, a third wider: a curve that leaves it is cut, not shrunk to a line.
std::string plot(const Case& what, const Numbers& got, const PlotTexts& texts);

/// Text made safe between the tags of a page.
std::string escaped(const std::string& text);

}  // namespace coursework
