// Line charts by gnuplot: NAME.csv, NAME.gp and from them NAME.svg, NAME.pdf, NAME.png, all in one style.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/table.h"

namespace crosscheck {

/// How a method looks, the same in every figure: colour, dash and marker, so that no meaning hangs on colour alone.
struct MethodStyle {
  std::string colour;  // "#RRGGBB"
  std::string dash;    // gnuplot dash type
  int marker;          // gnuplot point type
};
MethodStyle style_of(const std::string& method);

struct Curve {
  std::string title;  // shown in the key
  MethodStyle style;
  std::vector<std::pair<double, double>> points;
  bool line = true;      // joined by a line
  bool markers = false;  // a marker on every point; otherwise on a few
};

/// A run that failed, drawn as a cross with its verdict.
struct FailureMark {
  std::string title;
  MethodStyle style;
  double x, y;
};

struct Axis {
  std::string label;  // "quantity / unit"
  bool logarithmic = false;
  std::optional<double> low, high;
};

struct Figure {
  std::string name;     // file name without ending
  std::string title;    // what it shows
  std::string caption;  // scene, truth tier, error bar, step, commit
  std::string finding;  // what one sees in it, in a sentence: the alternative text
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<FailureMark> failures;
  std::optional<std::pair<std::string, double>> floor;     // horizontal line: name, y
  std::optional<std::pair<double, std::string>> window;    // grey from x on: x, why
  std::vector<std::pair<double, std::string>> categories;  // tick texts on x instead of numbers
  bool from_costs = false;                                 // drawn from timings: not the same in each run
};

/// Writes and draws the figure into the folder (style.gp is put beside it). Throws std::runtime_error that names the
/// figure when there is nothing to draw, a number is not finite, or gnuplot complains.
void draw_figure(const Figure& figure, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
