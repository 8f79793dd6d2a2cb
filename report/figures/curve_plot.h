#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "report/figures/charts.h"
#include "report/figures/plot_layout.h"

namespace crosscheck {

constexpr auto pareto_title = "Pareto front", grey = "#9AA3AC", grey_ink = "#66707A";

/// Curves that share a name and a colour, such as a method's curve and its failures, or a theory and its measurement.
struct NamedCurves {
  std::string title, name;
  MethodStyle style;
  std::vector<const Curve*> curves;
  std::vector<const FailureMark*> failures;
  bool coloured = false;

  bool has_line() const {
    return std::ranges::any_of(curves, [](const Curve* c) { return c->line && c->points.size() > 1; });
  }
};

std::vector<NamedCurves> named_parts(const Figure& f);

/// Ranges of both axes. `y_high` lies below the strip where failed runs are drawn. Values below `y_floor` are drawn on
/// the axis.
struct PlotRange {
  double x_low, x_high, y_low, y_high, y_floor = -INFINITY;
};
PlotRange plot_range(const Figure& f, const std::vector<NamedCurves>& parts);

/// True if the name is shown in the key, because scattered marks have no end next to which a label could be placed.
bool named_in_key(const Figure& f, const std::vector<NamedCurves>& parts, const NamedCurves& part);

std::string kind_of(const FailureMark& mark);
/// Meanings, and gnuplot point types, of the marks that no named curve explains (failures, scaled times, low values).
std::vector<std::pair<std::string, int>> mark_meanings(const Figure& f, double y_floor);

/// Lays out a figure for paper and writes its script. Keeps a reference to the figure.
class CurvePlot {
 public:
  explicit CurvePlot(const Figure& f) : f_(f), parts_(named_parts(f)), wide_(f.size.units()) {
    const PlotRange range = plot_range(f, parts_);
    x_low_ = range.x_low, x_high_ = range.x_high, y_low_ = range.y_low, y_data_ = range.y_high;
    y_floor_ = range.y_floor;
    frame(0);
    fill_board();
    if (!place_names()) {
      // labels that do not fit next to their curves go into a column at the right
      double widest = 0;
      for (const size_t i : ending_right_) widest = std::max(widest, width_of(parts_[i].name));
      frame(widest + 24);
      fill_board();
      column_of_names();
      place_names();
    }
    place_lines();
    place_kinds();
  }

  std::string script() const;

 private:
  struct Label {
    Place at;
    std::string words, align, colour;
  };

  double scaled(const Axis& axis, double value) const { return axis.logarithmic ? std::log10(value) : value; }
  Place place(double x, double y) const {
    const double left = scaled(f_.x, x_low_), right = scaled(f_.x, x_high_), bottom = scaled(f_.y, y_low_),
                 top = scaled(f_.y, y_high_);
    return {box_.left + (scaled(f_.x, x) - left) / (right - left) * (box_.right - box_.left),
            box_.bottom + (scaled(f_.y, std::max(y, y_floor_)) - bottom) / (top - bottom) * (box_.top - box_.bottom)};
  }
  double y_of_row(size_t row) const { return box_.top - 8 - 11 * static_cast<double>(row); }
  double value_at(double place_y) const {
    const double part = (place_y - box_.bottom) / (box_.top - box_.bottom),
                 at = scaled(f_.y, y_low_) + part * (scaled(f_.y, y_high_) - scaled(f_.y, y_low_));
    return f_.y.logarithmic ? std::pow(10, at) : at;
  }
  /// True if the name is short enough for a label; longer names are in the key.
  bool is_short(const NamedCurves& part) const { return width_of(part.name) < 0.45 * wide_; }

  /// Position of a marker that identifies an entry's crosses without relying on colour: left of the crosses, or right
  /// of them near the frame. Returns nullopt if only one entry has failures or the entry has no marker.
  std::optional<Place> sign_of(const NamedCurves& part, size_t row) const;
  void assign_rows();
  void frame(double right_column);
  void frame_numbers();
  void frame_categories();
  void fill_board();
  bool place_names();
  bool place_beside(const std::string& words, const std::string& colour, const std::vector<std::vector<Place>>& paths,
                    const std::vector<Place>& marks, const std::vector<std::vector<Place>>& others);
  void column_of_names();
  void place_lines();
  void place_kinds();
  std::vector<std::vector<Place>> paths_of(const NamedCurves& part) const;
  std::vector<Place> crosses_of(const NamedCurves& part) const;
  std::string elements() const;

  const Figure& f_;
  std::vector<NamedCurves> parts_;
  double wide_, x_low_ = 0, x_high_ = 1, y_low_ = 0, y_high_ = 1;
  double y_floor_ = -INFINITY;
  double y_data_ = 1;  // upper end of the data, below the strip of failures
  std::map<const FailureMark*, size_t> rows_;
  size_t strip_ = 0;
  std::vector<Tick> x_ticks_, y_ticks_;
  int turned_ = 0;
  double room_below_ = 0;  // space for the tick labels
  double column_ = 0;      // width of the column of names; 0: none
  bool y_title_on_top_ = false;
  Rect box_{};  // excludes the key below the plot
  std::optional<Board> board_;
  std::vector<Label> labels_;
  std::vector<KeyEntry> key_;
  std::vector<KeyEntry> remarks_;  // above the frame
  std::set<size_t> done_;          // entries with a label
  std::vector<size_t> ending_right_;
  struct Leader {
    Place from, to;
    MethodStyle style;
  };
  std::vector<Leader> leaders_;  // lines from curve ends to the column of names
};

}  // namespace crosscheck
