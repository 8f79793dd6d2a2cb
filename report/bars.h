// Stacked bars: one line per method, what came in to the left of zero, where it went to the right.
#pragma once

#include "report/figure.h"

namespace crosscheck {

struct Bars : FigureWords {
  struct Part {
    std::string title;           // in the key
    std::string colour;          // "#RRGGBB"
    bool hatched;                // inferred, not measured
    std::vector<double> height;  // of each bar; above zero stacked upwards, below zero downwards
  };
  std::string label;               // of the heights: "energy / J"
  std::vector<std::string> names;  // of the bars
  std::vector<Part> parts;         // from zero outwards
};

/// Throws std::runtime_error that names the figure when there is nothing to draw or a number is not finite.
Drawing drawing_of(const Bars& bars);

}  // namespace crosscheck
