// Figures drawn by gnuplot (NAME.csv, NAME.gp; from them NAME.svg, NAME.pdf, NAME.png): curves, bars, dots, heat maps.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace crosscheck {

/// Style of a method, the same in every figure. Colour, dash and marker differ, so that no meaning depends on colour
/// alone.
struct MethodStyle {
  std::string colour;  // "#RRGGBB"
  std::string dash;    // gnuplot dash type
  int marker;          // gnuplot point type
};
MethodStyle style_of(const std::string& method);
/// The style of the built-in methods without a style of their own, counted from 0; no other method has it.
MethodStyle spare_style(size_t place);

/// Tooltip and run of a marker or a cell on the page.
struct Tooltip {
  std::string words;     // shown when a pointer is above it
  std::string run = {};  // run that a click plays (FigureInfo::runs): the method, a blank, its index among the method's
                         // runs
};

inline constexpr int no_marker = 0;  // gnuplot's dot

struct Curve {
  std::string title;  // shown in the key
  MethodStyle style;  // no_marker: the reference that methods are compared with
  std::vector<std::pair<double, double>> points;
  bool line = true;                    // joined by a line
  bool markers = false;                // a marker on every point; otherwise on a few
  std::vector<Tooltip> tooltips = {};  // one per marker, or empty
  std::string method = {};             // method whose colour it has on the page, if the title names none
};

/// A failed run, drawn as a cross with its verdict.
struct FailureMark {
  std::string title;
  MethodStyle style;
  double x, y;
  std::string kind = "failed";  // in the key, if the colour shows the method
  int cross = 2;                // gnuplot point type, one per kind
  Tooltip tooltips = {};
};

struct Axis {
  std::string label;  // "quantity / unit"
  bool logarithmic = false;
  std::optional<double> low = {}, high = {};
};

/// Size of a figure on paper. The layout depends on width / font.
struct FigureSize {
  double width = 17;   // cm
  double font = 8.5;   // pt, on paper
  bool titled = true;  // false: the title is in the caption
  /// Its width in units of 1/12 of the font size.
  double units() const { return width / 2.54 * 72 * 12 / font; }
};
/// Resolution of the PNG: 300, less above 30 cm, because posters are viewed from a distance.
double pixels_per_inch(const FigureSize& size);

/// The common parts of every figure.
struct FigureInfo {
  std::string name;         // file name without ending
  std::string title;        // above the plot
  std::string caption;      // scene, step, commit; all_charts() adds the tier
  std::string tier;         // the reference and its accuracy: "exact (Coulomb's law)"
  std::string finding;      // one sentence, also the alternative text
  bool from_costs = false;  // drawn from timings, which differ in every run
  FigureSize size = {};
  std::string runs = {};  // set of runs that its markers or cells play; empty: none
};

/// A labelled line at a value of an axis.
struct Guide {
  bool of_x = false;
  double at = 0;
  std::string text;
};

/// Parts of a figure that only the page shows.
struct OnPage {
  struct Take {
    double x = 0, y = 0;
    std::string name, more;
  };
  std::optional<Take> take;  // the recommended run, drawn with a ring
  bool flat = false;         // next to pictures: less high than wide
};

/// Curves, points and crosses over two axes.
struct Figure : FigureInfo {
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<FailureMark> failures;
  std::vector<std::pair<double, double>> pareto;           // thick stairs beneath the curves, from left to right
  std::optional<std::pair<std::string, double>> floor;     // horizontal line: name, y
  std::optional<std::pair<double, std::string>> window;    // grey beyond x: x, its label
  std::vector<std::pair<double, std::string>> categories;  // tick labels on x instead of numbers
  std::vector<Guide> guides;
  std::optional<double> cut;  // lower values are drawn on the axis
  OnPage on_page = {};
};

/// A figure's data, and the script that draws NAME.svg, NAME.pdf and NAME.png from NAME.csv.
struct Drawing {
  std::string name;
  Table data;
  std::string script;
};
/// Throws std::runtime_error with the figure's name if there is nothing to draw or a number is not finite.
Drawing drawing_of(const Figure& figure);

/// Writes and draws it into the folder, next to style.gp; prints gnuplot's warnings to stderr. Throws
/// std::runtime_error with the figure's name if gnuplot fails, or if a file is missing, empty or truncated.
void draw(const Drawing& drawing, const Provenance& provenance, const std::filesystem::path& folder);

/// The end of a script: the terminals for a figure of this height (units), each with the plot command.
std::string terminals(const FigureInfo& figure, double height, const std::string& plot);
/// Like terminals(), for a block that draws everything, including reset and style.
std::string terminals_of_block(const FigureInfo& figure, double height, const std::string& block);

// Stacked bars: one line per method; supplied energy to the left of zero, all else to the right.

struct StackedBars : FigureInfo {
  struct Part {
    std::string title;           // in the key
    std::string colour;          // "#RRGGBB"
    bool hatched;                // inferred, not measured
    std::vector<double> height;  // one per bar; above zero stacked upwards, below zero downwards
  };
  std::string label;               // label of the heights: "energy / J"
  std::vector<std::string> names;  // names of the bars
  std::vector<Part> parts;         // from zero outwards
};

/// Throws std::runtime_error with the figure's name if there is nothing to draw or a number is not finite.
Drawing drawing_of(const StackedBars& bars);

// Dots with intervals: one line per name, one marker per series, over a logarithmic axis.

struct DotPlot : FigureInfo {
  struct Dot {
    double value, low, high;  // all above zero
  };
  struct Series {
    std::string title;                     // in the key
    MethodStyle style;                     // its dash is not used
    std::vector<std::optional<Dot>> dots;  // one per line
  };
  std::string label;               // label of the values
  std::vector<std::string> names;  // names of the lines, from the top
  /// Headings, each above the line with that index.
  std::vector<std::pair<size_t, std::string>> headings;
  std::vector<Series> series;
  std::string right_of_one = {};  // meaning of values above 1, written next to the line at 1
};

/// Throws std::runtime_error with the figure's name if there is nothing to draw or a value is not above zero.
Drawing drawing_of(const DotPlot& dots);

// Heat maps: outcomes of runs over two logarithmic axes, in panels that share the axes, with lines of limits.

/// A kind of cell: its name in the key, and its colour. Colours differ in lightness, too.
struct CellKind {
  std::string title;
  std::string colour;  // "#RRGGBB"
};

struct HeatMap : FigureInfo {
  struct HeatCell {
    double x, y;  // logarithmic centre
    int kind;     // index in `kinds`
    Tooltip tooltips = {};
  };
  struct Panel {
    std::string title;
    std::vector<HeatCell> cells;                       // a full grid
    std::vector<std::pair<double, double>> predicted;  // drawn as a dashed line
    std::vector<std::pair<double, double>> measured;   // drawn as dots
  };
  std::string x_label, y_label;
  std::vector<CellKind> kinds;
  std::vector<Panel> panels;
};

/// Throws std::runtime_error with the figure's name if there is nothing to draw or a value is not above zero.
Drawing drawing_of(const HeatMap& map);

}  // namespace crosscheck
