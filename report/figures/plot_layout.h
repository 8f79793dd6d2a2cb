// What a figure on paper is laid out by: ticks, keys, and places for names beside curves, all in units of which a
// letter is 12 high whatever the figure's size.
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
  std::string text;  // empty: a small tick between others
};
/// Round numbers from `low` to `high` on an axis of this length, as many as there is room for.
std::vector<Tick> ticks_of(double low, double high, bool logarithmic, double length, bool upright);
/// The command that sets them: "set xtics ('1' 1, '' 2 1)".
std::string tick_command(const std::string& letter, const std::vector<Tick>& ticks);

/// Darkened until it reads as text on white.
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

/// Commands that draw on the sheet at places in units from its bottom left.
class Sheet {
 public:
  /// `up`: by which all places lie higher, for instance above a key.
  Sheet(double wide, double tall, double up = 0) : wide_(wide), tall_(tall), up_(up) {}
  std::string at(Place p) const;
  /// `align`: left, center or right; `more`: for instance "rotate by 90".
  std::string text(Place p, const std::string& words, const std::string& align, const std::string& colour,
                   const std::string& more = "") const;
  std::string mark(Place p, const std::string& colour, int marker, double size = 0.8) const;
  std::string line(Place from, Place to, const std::string& colour, double thick, const std::string& dash) const;
  std::string box(Rect r, const std::string& colour, const std::string& fill = "solid") const;
  /// Of the margins, so that the plot has this box.
  std::string margins(const Rect& box) const;

 private:
  double wide_, tall_, up_;
};

/// A figure's data. Throws std::runtime_error that names it when there is no row or a number is not finite.
Table checked(Table data);

/// The first lines of a script.
std::string script_head(const FigureInfo& figure);
/// Its title above the plot, or nothing.
std::string title_command(const Sheet& sheet, const FigureInfo& figure, Place middle);

struct KeyEntry {
  enum class Kind { line, mark, box };
  std::string text;
  Kind kind;
  MethodStyle style;
  std::string fill = "solid";  // of a box
};
/// The height of a key of this width, which grows by lines.
double key_height(const std::vector<KeyEntry>& entries, double wide);
/// The key from this top left corner on.
std::string key_commands(const Sheet& sheet, const std::vector<KeyEntry>& entries, Place top_left, double wide);

/// A text that is cut where it is wider than the room: at a colon, a comma or a parenthesis if it has one.
std::string shortened(const std::string& text, double room);

/// The method that a title names, with its prefix or without; empty where it names none.
std::string method_named(const std::string& title);

/// A title as a reader knows it: the name of an engine, a blank, its rule. Programs differ from those in the titles
/// `beside` it.
std::string reader_name(const std::string& title, std::span<const std::string> beside = {});
/// The method's rule as the literature names it, and its options: "symplectic Euler", "Heun, events".
std::string rule_name(const std::string& method);

inline constexpr double line_of_names = 17;  // from one name to the next

/// Names at the left, one below the other, and an axis under the plot: what bars, dots and limits have in common.
struct NamedLines {
  /// `right`: the room right of the plot.
  NamedLines(const FigureInfo& figure, const std::string& label, const std::vector<std::string>& titles, double lines,
             const std::vector<KeyEntry>& key, double right = 14);
  double y_of(double place) const { return box.top - 2 - line_of_names * (place - 0.5); }
  std::string commands(const FigureInfo& figure, const std::vector<Tick>& ticks) const;
  /// The name of that index at a line.
  std::string name(double place, size_t index) const;
  /// A text that starts at the sheet's left edge.
  std::string heading(double place, const std::string& text) const;
  /// A text at a line that ends there.
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

/// What stands on a plot already, for names that look for a place.
class Board {
 public:
  explicit Board(const Rect& box);
  void add_line(Place from, Place to, bool yields = false);
  void add_mark(Place at);
  void add(const Rect& taken);
  /// How much a text covers of what yields; nothing where it covers something else or leaves the box.
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
