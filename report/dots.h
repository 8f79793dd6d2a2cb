// Dots with intervals: one line per name, a marker for each series, over a logarithmic axis.
#pragma once

#include "report/figure.h"

namespace crosscheck {

struct Dots : FigureWords {
  struct Dot {
    double value, low, high;  // all above zero
  };
  struct Series {
    std::string title;                     // in the key
    MethodStyle style;                     // its dash is not used
    std::vector<std::optional<Dot>> dots;  // one for each line
  };
  std::string label;               // of the values
  std::vector<std::string> names;  // of the lines, from above
  /// Headings, each above the line of that index.
  std::vector<std::pair<size_t, std::string>> headings;
  std::vector<Series> series;
};

/// Throws std::runtime_error that names the figure when there is nothing to draw or a value is not above zero.
Drawing drawing_of(const Dots& dots);

}  // namespace crosscheck
