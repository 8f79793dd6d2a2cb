// Heat maps: what became of each run over two logarithmic axes, in panels that share the axes, with lines of limits.
#pragma once

#include "report/figure.h"

namespace crosscheck {

/// A kind of cell: its name in the key, and its colour. Colours differ in lightness too.
struct CellKind {
  std::string title;
  std::string colour;  // "#RRGGBB"
};

struct HeatMap : FigureWords {
  struct HeatCell {
    double x, y;  // the middle, in the logarithm
    int kind;     // of `kinds`
    Tip told = {};
  };
  struct Panel {
    std::string title;
    std::vector<HeatCell> cells;                       // of a full grid
    std::vector<std::pair<double, double>> predicted;  // a dashed line
    std::vector<std::pair<double, double>> measured;   // dots
  };
  std::string x_label, y_label;
  std::vector<CellKind> kinds;
  std::vector<Panel> panels;
};

/// Throws std::runtime_error that names the figure when there is nothing to draw or a value is not above zero.
Drawing drawing_of(const HeatMap& map);
/// What its cells say, in the order of the script.
std::vector<Tip> told_of(const HeatMap& map);

}  // namespace crosscheck
