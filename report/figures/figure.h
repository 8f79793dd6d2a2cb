// Figures by gnuplot (NAME.csv, NAME.gp, and from them NAME.svg, NAME.pdf, NAME.png): curves, bars, dots, heat maps.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace crosscheck {

/// The style of a method, the same in every figure: colour, dash and marker, so that no meaning hangs on colour alone.
struct MethodStyle {
  std::string colour;  // "#RRGGBB"
  std::string dash;    // gnuplot dash type
  int marker;          // gnuplot point type
};
MethodStyle style_of(const std::string& method);
/// The style of the built-in engines' method, counted from 0, that brings none: no other method has it.
MethodStyle spare_style(size_t place);

/// The tooltip and the run of a marker or a cell on the page.
struct Tooltip {
  std::string words;     // shown while a pointer is above it
  std::string run = {};  // what a click plays (FigureInfo::runs): the method, a blank, the place among its runs
};

inline constexpr int no_marker = 0;  // gnuplot's dot

struct Curve {
  std::string title;  // shown in the key
  MethodStyle style;  // with no_marker: what a method is compared with
  std::vector<std::pair<double, double>> points;
  bool line = true;                    // joined by a line
  bool markers = false;                // a marker on every point; otherwise on a few
  std::vector<Tooltip> tooltips = {};  // of each marker, or empty
  std::string method = {};             // whose colour it has on the page, where the title names none
};

/// A run that failed, drawn as a cross with its verdict.
struct FailureMark {
  std::string title;
  MethodStyle style;
  double x, y;
  std::string kind = "failed";  // in the key, where the colour shows the method
  int cross = 2;                // gnuplot point type, one for each kind
  Tooltip tooltips = {};
};

struct Axis {
  std::string label;  // "quantity / unit"
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};
};

/// The size of a figure on paper. Its layout follows its width over its font.
struct FigureSize {
  double width = 17;   // cm
  double font = 8.5;   // pt, on paper
  bool titled = true;  // false: the caption has the title's text
  /// Its width where a font is 12 high.
  double units() const { return width / 2.54 * 72 * 12 / font; }
};
/// Of its PNG: 300, fewer above 30 cm, since a poster is seen from afar.
double pixels_per_inch(const FigureSize& size);

/// The parts of every figure, whatever it draws.
struct FigureInfo {
  std::string name;         // file name without ending
  std::string title;        // above the plot
  std::string caption;      // scene, step, commit; all_charts() adds the tier
  std::string tier;         // the reference and how well it is known: "exact (Coulomb's law)"
  std::string finding;      // one sentence, also the alternative text
  bool from_costs = false;  // drawn from timings: not the same in each run
  FigureSize size = {};
  std::string runs = {};  // the set of runs that its markers or cells play; empty: none
};

/// A line at a place of an axis, with its name.
struct Guide {
  bool of_x = false;
  double at = 0;
  std::string text;
};

/// What the page alone shows of a figure.
struct OnPage {
  struct Take {
    double x = 0, y = 0;
    std::string name, more;
  };
  std::optional<Take> take;  // the run to take, ringed
  bool flat = false;         // beside pictures: less high than wide
};

/// Curves, points and crosses over two axes.
struct Figure : FigureInfo {
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<FailureMark> failures;
  std::vector<std::pair<double, double>> pareto;           // thick stairs beneath the curves, from left to right
  std::optional<std::pair<std::string, double>> floor;     // horizontal line: name, y
  std::optional<std::pair<double, std::string>> window;    // grey from x on: x, its label
  std::vector<std::pair<double, std::string>> categories;  // tick texts on x instead of numbers
  std::vector<Guide> guides;
  std::optional<double> cut;  // lower values lie on the axis
  OnPage on_page = {};
};

/// A figure's data, and the script that draws NAME.svg, NAME.pdf and NAME.png from NAME.csv.
struct Drawing {
  std::string name;
  Table data;
  std::string script;
};
/// Throws std::runtime_error that names the figure when there is nothing to draw or a number is not finite.
Drawing drawing_of(const Figure& figure);

/// Writes and draws it into the folder (style.gp is put next to it); what gnuplot warns of is reported on stderr.
/// Throws std::runtime_error that names the figure when gnuplot fails, or a form of it is missing, empty or cut off.
void draw(const Drawing& drawing, const Provenance& provenance, const std::filesystem::path& folder);

/// The end of a script: the terminals for a figure so many units high, each with the plot command.
std::string terminals(const FigureInfo& figure, double height, const std::string& plot);
/// The same for a block that draws everything, reset and style included, so many units high.
std::string terminals_of_block(const FigureInfo& figure, double height, const std::string& block);

// Stacked bars: one line per method; supplied energy left of zero, the rest right of it.

struct StackedBars : FigureInfo {
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
Drawing drawing_of(const StackedBars& bars);

// DotPlot with intervals: one line per name, a marker for each series, over a logarithmic axis.

struct DotPlot : FigureInfo {
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
  std::string right_of_one = {};  // the meaning of values above 1: stands beside a line there
};

/// Throws std::runtime_error that names the figure when there is nothing to draw or a value is not above zero.
Drawing drawing_of(const DotPlot& dots);

// Heat maps: what became of each run over two logarithmic axes, in panels that share the axes, with lines of limits.

/// A kind of cell: its name in the key, and its colour. Colours differ in lightness too.
struct CellKind {
  std::string title;
  std::string colour;  // "#RRGGBB"
};

struct HeatMap : FigureInfo {
  struct HeatCell {
    double x, y;  // the middle, in the logarithm
    int kind;     // of `kinds`
    Tooltip tooltips = {};
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

}  // namespace crosscheck
