// Layout of printed figures: ticks, keys, and room for labels next to curves. The unit is 1/12 of the font size,
// whatever the figure's size.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/figures/figure.h"

namespace crosscheck {

inline constexpr double letter_height = 12, line_of_text = 15;

/// The width of a text in units.
double width_of(const std::string& text);

/// A number as people write it: "0.001", "2·10⁻⁷".
std::string tick_text(double value);

struct Tick {
  double at;
  std::string text;  // empty: a minor tick
};
/// Round numbers from `low` to `high` on an axis of this length, as many as fit.
std::vector<Tick> ticks_of(double low, double high, bool logarithmic, double length, bool upright);
/// The gnuplot command that sets the ticks: "set xtics ('1' 1, '' 2 1)".
std::string tick_command(const std::string& letter, const std::vector<Tick>& ticks);

/// The colour, darkened until it is legible as text on white.
std::string ink_of(const std::string& colour);

struct Place {
  double x, y;
};
struct Rect {
  double left, right, bottom, top;
  bool meets(const Rect& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

/// Commands that draw on the sheet, at positions in units from its bottom left corner.
class Sheet {
 public:
  /// `up`: offset added to all heights, for instance for a key below.
  Sheet(double wide, double tall, double up = 0) : wide_(wide), tall_(tall), up_(up) {}
  std::string at(Place p) const;
  /// `align`: left, center or right; `more`: for instance "rotate by 90".
  std::string text(Place p, const std::string& words, const std::string& align, const std::string& colour,
                   const std::string& more = "") const;
  std::string mark(Place p, const std::string& colour, int marker, double size = 0.8) const;
  std::string line(Place from, Place to, const std::string& colour, double thick, const std::string& dash) const;
  std::string box(Rect r, const std::string& colour, const std::string& fill = "solid") const;
  /// Sets the margins so that the plot has this box.
  std::string margins(const Rect& box) const;

 private:
  double wide_, tall_, up_;
};

/// Returns a figure's data. Throws std::runtime_error with its name if there is no row or a number is not finite.
Table checked(Table data);

/// The first lines of a script.
std::string script_head(const FigureInfo& figure);
/// The figure's title above the plot, or nothing.
std::string title_command(const Sheet& sheet, const FigureInfo& figure, Place middle);

struct KeyEntry {
  enum class Kind { line, mark, box };
  std::string text;
  Kind kind;
  MethodStyle style;
  std::string fill = "solid";  // fill style of a box
};
/// The height of a key of this width; entries wrap into lines.
double key_height(const std::vector<KeyEntry>& entries, double wide);
/// Draws the key from this top left corner.
std::string key_commands(const Sheet& sheet, const std::vector<KeyEntry>& entries, Place top_left, double wide);

/// The text, truncated if it is wider than the room: at a colon, a comma or a parenthesis, if possible.
std::string shortened(const std::string& text, double room);

/// The method that a title names, with or without its prefix; empty if there is none.
std::string method_named(const std::string& title);

/// A title as readers know it: the name of an engine, a blank, its rule. Programs get names that differ from those in
/// the titles `beside`.
std::string reader_name(const std::string& title, std::span<const std::string> beside = {});
/// The method's rule as the literature names it, and its options: "symplectic Euler", "Heun, events".
std::string rule_name(const std::string& method);

inline constexpr double line_of_names = 17;  // distance between names

/// Names on the left, one below the other, and an axis under the plot: shared by bars, dots and limits.
struct NamedLines {
  /// `right`: width to the right of the plot.
  NamedLines(const FigureInfo& figure, const std::string& label, const std::vector<std::string>& titles, double lines,
             const std::vector<KeyEntry>& key, double right = 14);
  double y_of(double place) const { return box.top - 2 - line_of_names * (place - 0.5); }
  std::string commands(const FigureInfo& figure, const std::vector<Tick>& ticks) const;
  /// Draws the name with that index on a line.
  std::string name(double place, size_t index) const;
  /// Draws a text that starts at the sheet's left edge.
  std::string heading(double place, const std::string& text) const;
  /// Draws a text on a line, ending at x.
  std::string ending_at(double x, double place, const std::string& text) const {
    return Sheet(wide, tall, below).text({x, y_of(place)}, text, "right", "#222222");
  }
  std::string y_range(double lines) const;

  double wide, tall, below;
  Rect box;
  std::vector<std::string> names;
  std::vector<KeyEntry> entries;
  std::string words;
};

/// "plot a, \\ b"
std::string joined_plot(const std::vector<std::string>& parts);

/// Occupied areas of a plot, for labels that look for room.
class Board {
 public:
  explicit Board(const Rect& box);
  void add_line(Place from, Place to, bool yields = false);
  void add_mark(Place at);
  void add(const Rect& taken);
  /// Amount of yielding content that a text would cover; nothing if it would cover anything else or leave the box.
  std::optional<double> cost(const Rect& text) const;

 private:
  int& cell(double x, double y) {
    return cells_[static_cast<size_t>(row(y)) * across_ + static_cast<size_t>(column(x))];
  }
  int column(double x) const;
  int row(double y) const;
  Rect box_;
  size_t across_, down_;
  std::vector<int> cells_;
};

}  // namespace crosscheck
