#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace crosscheck {

/// Style of a method, the same in every figure. Styles also differ in dash and marker, because some readers cannot
/// distinguish colours.
struct MethodStyle {
  std::string colour;  // "#RRGGBB"
  std::string dash;    // gnuplot dash type
  int marker;          // gnuplot point type
};
MethodStyle style_of(const std::string& method);
/// Spare style number `place`, from 0, for a built-in method without a style of its own. No other method uses it.
MethodStyle spare_style(size_t place);

struct Tooltip {
  std::string words;     // shown when the pointer is on the marker
  std::string run = {};  // run that a click plays: "METHOD INDEX", the index among the method's runs
};

inline constexpr int no_marker = 0;  // gnuplot's dot

struct Curve {
  std::string title;  // in the key
  MethodStyle style;  // no_marker: the curve is a reference, not a method
  std::vector<std::pair<double, double>> points;
  bool line = true;
  bool markers = false;                // true: a marker on every point; false: a few markers
  std::vector<Tooltip> tooltips = {};  // one per marker
  std::string method = {};             // the method whose colour the page uses if the title names no method
};

struct FailureMark {
  std::string title;
  MethodStyle style;
  double x, y;
  std::string kind = "failed";  // explained in the key if the colour shows the method
  int cross = 2;                // gnuplot point type, one per kind
  Tooltip tooltips = {};
};

struct Axis {
  std::string label;  // "quantity / unit"
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};
};

/// Size of a printed figure. The layout depends only on width / font.
struct FigureSize {
  double width = 17;   // cm
  double font = 8.5;   // pt, on paper
  bool titled = true;  // false: the caption contains the title
  /// Width in units of 1/12 of the font size.
  double units() const { return width / 2.54 * 72 * 12 / font; }
};
/// Resolution: 300, or less for figures wider than 30 cm, because posters are viewed from a distance.
double pixels_per_inch(const FigureSize& size);

struct FigureInfo {
  std::string name;         // file name without extension
  std::string title;        // above the plot
  std::string caption;      // scene, step, commit; all_charts() adds the tier
  std::string tier;         // reference and its accuracy: "exact (Coulomb's law)"
  std::string finding;      // a sentence, also the alternative text
  bool from_costs = false;  // drawn from timings, which differ in every run
  FigureSize size = {};
  std::string runs = {};  // the set of runs that the figure's markers or cells play
};

struct Guide {
  bool of_x = false;
  double at = 0;
  std::string text;
};

struct OnPage {
  struct Take {
    double x = 0, y = 0;
    std::string name, more;
  };
  std::optional<Take> take;  // recommended run, drawn with a ring
  bool flat = false;         // true: a lower chart, to be shown next to pictures
};

struct Figure : FigureInfo {
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<FailureMark> failures;
  std::vector<std::pair<double, double>> pareto;           // drawn as stairs beneath the curves, from left to right
  std::optional<std::pair<std::string, double>> floor;     // horizontal line: name, y
  std::optional<std::pair<double, std::string>> window;    // the plot is grey beyond this x; label
  std::vector<std::pair<double, std::string>> categories;  // tick labels on x
  std::vector<Guide> guides;
  std::optional<double> cut;  // lower values are drawn on the axis
  OnPage on_page = {};
};

/// Data for NAME.csv, and a gnuplot script NAME.gp that draws NAME.svg, NAME.pdf and NAME.png from it.
struct Drawing {
  std::string name;
  Table data;
  std::string script;
};
/// Each drawing_of() throws std::runtime_error with the figure's name if there is nothing to draw, a number is not
/// finite, or a value on the logarithmic axis of a dot plot or heat map is not above zero.
Drawing drawing_of(const Figure& figure);

/// Writes and draws a figure; also writes style.gp. Prints gnuplot's warnings to stderr. Throws std::runtime_error with
/// the figure's name if gnuplot fails, or if a file is missing, empty or truncated.
void draw(const Drawing& drawing, const Provenance& provenance, const std::filesystem::path& folder);

/// End of a script: draws a figure of this height (units) on each terminal.
std::string terminals(const FigureInfo& figure, double height, const std::string& plot);
/// Like terminals(), for a script block that draws everything, including reset and style.
std::string terminals_of_block(const FigureInfo& figure, double height, const std::string& block);

// Stacked bars, one per method: supplied energy to the left of zero, all else to the right.

struct StackedBars : FigureInfo {
  struct Part {
    std::string title;
    std::string colour;          // "#RRGGBB"
    bool hatched;                // inferred, not measured
    std::vector<double> height;  // one per bar; positive ones are stacked upwards, negative ones downwards
  };
  std::string label;  // "energy / J"
  std::vector<std::string> names;
  std::vector<Part> parts;  // stacked from zero outwards
};

Drawing drawing_of(const StackedBars& bars);

// Dots with intervals over a logarithmic axis: one line per name, one marker per series.

struct DotPlot : FigureInfo {
  struct Dot {
    double value, low, high;  // positive
  };
  struct Series {
    std::string title;
    MethodStyle style;                     // the dash is not used
    std::vector<std::optional<Dot>> dots;  // one per line
  };
  std::string label;
  std::vector<std::string> names;  // top to bottom
  /// Each heading is above the line with its index.
  std::vector<std::pair<size_t, std::string>> headings;
  std::vector<Series> series;
  std::string right_of_one = {};  // meaning of values above 1
};

Drawing drawing_of(const DotPlot& dots);

// Heat maps: outcomes of runs over two logarithmic axes, in panels that share the axes, with limits as lines.

/// Colours also differ in lightness.
struct CellKind {
  std::string title;
  std::string colour;  // "#RRGGBB"
};

struct HeatMap : FigureInfo {
  struct HeatCell {
    double x, y;  // centre on the logarithmic axes
    int kind;     // index in `kinds`
    Tooltip tooltips = {};
  };
  struct Panel {
    std::string title;
    std::vector<HeatCell> cells;                       // a full grid
    std::vector<std::pair<double, double>> predicted;  // dashed line
    std::vector<std::pair<double, double>> measured;   // dots
  };
  std::string x_label, y_label;
  std::vector<CellKind> kinds;
  std::vector<Panel> panels;
};

Drawing drawing_of(const HeatMap& map);

}  // namespace crosscheck
