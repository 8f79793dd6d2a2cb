// Layout of printed figures: ticks, keys, and free space for labels. The unit is 1/12 of the font size.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/figures/figure.h"

namespace crosscheck {

inline constexpr double letter_height = 12, line_of_text = 15;

double width_of(const std::string& text);

/// "0.001", "2·10⁻⁷"
std::string tick_text(double value);

struct Tick {
  double at;
  std::string text;  // empty: a minor tick
};
/// Ticks at round numbers from `low` to `high`, as many as fit on an axis of this length.
std::vector<Tick> ticks_of(double low, double high, bool logarithmic, double length, bool upright);
/// "set xtics ('1' 1, '' 2 1)"
std::string tick_command(const std::string& letter, const std::vector<Tick>& ticks);

/// Darkens a colour until it is legible as text on white.
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

/// Commands that draw on the sheet, at positions from its bottom left corner.
class Sheet {
 public:
  /// `up` is added to all heights, for instance to leave space for a key below.
  Sheet(double wide, double tall, double up = 0) : wide_(wide), tall_(tall), up_(up) {}
  std::string at(Place p) const;
  /// `align`: left, center or right; `more`: further gnuplot options such as "rotate by 90".
  std::string text(Place p, const std::string& words, const std::string& align, const std::string& colour,
                   const std::string& more = "") const;
  std::string mark(Place p, const std::string& colour, int marker, double size = 0.8) const;
  std::string line(Place from, Place to, const std::string& colour, double thick, const std::string& dash) const;
  std::string box(Rect r, const std::string& colour, const std::string& fill = "solid") const;
  /// Sets the margins so that `box` is the box of the plot.
  std::string margins(const Rect& box) const;

 private:
  double wide_, tall_, up_;
};

/// Returns the table. Throws std::runtime_error with the table's name if it has no row or a number is not finite.
Table checked(Table data);

std::string script_head(const FigureInfo& figure);
std::string title_command(const Sheet& sheet, const FigureInfo& figure, Place middle);

struct KeyEntry {
  enum class Kind { line, mark, box };
  std::string text;
  Kind kind;
  MethodStyle style;
  std::string fill = "solid";  // for a box
};
/// Entries wrap into lines.
double key_height(const std::vector<KeyEntry>& entries, double wide);
std::string key_commands(const Sheet& sheet, const std::vector<KeyEntry>& entries, Place top_left, double wide);

/// Truncates a text that is wider than `room`, preferably at a colon, a comma or a parenthesis.
std::string shortened(const std::string& text, double room);

/// The method in a title, where "mysim/" may be missing; empty if the title names no method.
std::string method_named(const std::string& title);

/// Title for readers: engine, a space, and the integrator. If two programs in the titles `beside` would have the same
/// name, their names are extended until they differ.
std::string reader_name(const std::string& title, std::span<const std::string> beside = {});
/// Name of the method's rule in the literature, with its options: "symplectic Euler", "Heun, events".
std::string rule_name(const std::string& method);

inline constexpr double line_of_names = 17;

/// Layout with one name per line at the left and an axis under the plot, as in bars, dots and limits.
struct NamedLines {
  /// `right`: space to the right of the plot.
  NamedLines(const FigureInfo& figure, const std::string& label, const std::vector<std::string>& titles, double lines,
             const std::vector<KeyEntry>& key, double right = 14);
  double y_of(double place) const { return box.top - 2 - line_of_names * (place - 0.5); }
  std::string commands(const FigureInfo& figure, const std::vector<Tick>& ticks) const;
  std::string name(double place, size_t index) const;
  /// Commands for a text at the sheet's left edge.
  std::string heading(double place, const std::string& text) const;
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

std::string joined_plot(const std::vector<std::string>& parts);

/// Occupied areas of a plot, to find room for labels.
class Board {
 public:
  explicit Board(const Rect& box);
  void add_line(Place from, Place to, bool yields = false);
  void add_mark(Place at);
  void add(const Rect& taken);
  /// Amount of yielding content that a text would cover, or nullopt if the text would cover other content or leave the
  /// box.
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
