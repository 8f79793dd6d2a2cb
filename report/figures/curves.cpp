// Curves over two axes as journals print them: names beside the curves, at most six of them in colour, the others
// grey, failures in a strip along the top.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>

#include "reference/method.h"
#include "report/base/gnuplot.h"
#include "report/figures/charts.h"
#include "report/figures/plot_layout.h"

namespace crosscheck {
namespace {

constexpr auto pareto_title = "Pareto front", grey = "#9AA3AC", grey_ink = "#66707A";
constexpr size_t most_in_colour = 6;

/// The name of a curve in the data file: gnuplot splits even quoted fields at commas.
std::string id_of(std::string title) {
  for (char& c : title)
    if (c == ',' || c == '"') c = ';';
  return title;
}

/// Every point as a row: curve, x, y. Throws where there is no point, or one that is not finite.
Table data_of(const Figure& f) {
  Table table{f.name, {{"curve", "1"}, {f.x.label, "see name"}, {f.y.label, "see name"}}, {}};
  auto add = [&](const std::string& curve, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y))
      throw std::runtime_error(fmt::format("figure {}: a value is not finite", f.name));
    table.add({id_of(curve), x, y});
  };
  for (const auto& [x, y] : f.pareto) add(pareto_title, x, y);
  for (const Curve& curve : f.curves)
    for (const auto& [x, y] : curve.points) add(curve.title, x, y);
  for (const FailureMark& mark : f.failures) add("failed: " + mark.title, mark.x, mark.y);
  if (table.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", f.name));
  return table;
}

/// What shares a name and a colour: a method's curve and its failures, a theory and its measurement.
struct Named {
  std::string title, name;
  MethodStyle style;
  std::vector<const Curve*> curves;
  std::vector<const FailureMark*> failures;
  bool coloured = false;

  bool has_line() const {
    return std::ranges::any_of(curves, [](const Curve* c) { return c->line && c->points.size() > 1; });
  }
};

std::string common_words(const std::string& a, const std::string& b) {
  size_t same = 0, last = 0;
  while (same < a.size() && same < b.size() && a[same] == b[same]) {
    if (a[same] == ' ') last = same;
    ++same;
  }
  if (same == a.size() || same == b.size()) last = same;
  while (last > 0 && (a[last - 1] == ',' || a[last - 1] == ':' || a[last - 1] == ' ')) --last;
  return a.substr(0, last);
}

/// The kind of a failure in a word.
std::string kind_of(const FailureMark& mark) {
  const size_t colon = mark.title.rfind(": ");
  return mark.kind == "failed" && colon != std::string::npos ? mark.title.substr(colon + 2) : mark.kind;
}

/// Who is drawn in colour first: what is no method, those that stand for an engine and those that move positions, its
/// other methods, integrators and all others.
int place_in_line(const Named& named) {
  const std::string method = method_named(named.title);
  if (method.empty()) return 0;
  const MethodFamily& family = family_of(method);
  const Method* known = builtin_method(method);
  if (family.role == Role::integrator) return 3;
  if (family.role == Role::outside || method == family.representative || family.role == Role::truth) return 1;
  if (!known) return builtin_without_options(method) ? 2 : 5;
  if (!family.by_default()) return 5;
  const Stepper* rule = known->stepper;
  if (rule && rule->symplectic && rule->evaluations == 1) return 1;
  if (!family.is_subject()) return known->position_based ? 1 : 2;
  return rule && rule->symplectic ? 3 : 4;
}

std::vector<Named> named_parts(const Figure& f) {
  std::vector<Named> all;
  for (const Curve& curve : f.curves) {
    if (curve.points.empty() || curve.title == scaled_times) continue;
    const std::string method = method_named(curve.title);
    auto it = std::ranges::find_if(all, [&](const Named& n) {
      return n.style.colour == curve.style.colour &&
             (method.empty() ? common_words(n.title, curve.title).size() > 3 : method == method_named(n.title));
    });
    if (it == all.end())
      it = all.insert(all.end(), {curve.title, "", curve.style, {}, {}});
    else
      it->title = common_words(it->title, curve.title);
    if (it->style.marker < 0) it->style.marker = curve.style.marker;
    it->curves.push_back(&curve);
  }
  for (const FailureMark& mark : f.failures) {
    const std::string method = method_named(mark.title);
    auto it = std::ranges::find_if(all, [&](const Named& n) {
      return n.style.colour == mark.style.colour &&
             (method.empty() ? mark.title.starts_with(n.title) : method == method_named(n.title));
    });
    if (it == all.end())
      it = all.insert(all.end(), {mark.title.substr(0, mark.title.rfind(": ")), "", mark.style, {}, {}});
    it->failures.push_back(&mark);
  }
  std::vector<size_t> order(all.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](size_t i) { return place_in_line(all[i]); });
  for (size_t i = 0; i < std::min(order.size(), most_in_colour); ++i) all[order[i]].coloured = true;
  const auto left = std::ranges::count_if(all, [](const Named& n) { return !n.coloured; });
  for (Named& n : all) n.name = n.coloured || left == 1 ? reader_name(n.title) : fmt::format("{} others", left);
  return all;
}

class CurvePlot {
 public:
  explicit CurvePlot(const Figure& f) : f_(f), parts_(named_parts(f)), wide_(f.size.units()) {
    set_ranges();
    frame(0);
    fill_board();
    if (!place_names()) {
      // names that find no place beside their curves stand in a column right of the plot
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
  /// The y of a row of the strip of failures.
  double y_of_row(size_t row) const { return box_.top - 8 - 11 * static_cast<double>(row); }
  double value_at(double place_y) const {
    const double part = (place_y - box_.bottom) / (box_.top - box_.bottom),
                 at = scaled(f_.y, y_low_) + part * (scaled(f_.y, y_high_) - scaled(f_.y, y_low_));
    return f_.y.logarithmic ? std::pow(10, at) : at;
  }
  /// A longer name stands in the key.
  bool is_short(const Named& part) const { return width_of(part.name) < 0.45 * wide_; }

  void set_ranges();
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
  std::vector<std::vector<Place>> paths_of(const Named& part) const;
  std::vector<Place> crosses_of(const Named& part) const;
  std::string elements() const;

  const Figure& f_;
  std::vector<Named> parts_;
  double wide_, x_low_ = 0, x_high_ = 1, y_low_ = 0, y_high_ = 1;
  double y_floor_ = -INFINITY;  // lower values lie on the axis
  double y_data_ = 1;           // the highest value below the strip of failures
  std::map<const FailureMark*, size_t> rows_;
  size_t strip_ = 0;  // rows of the strip of failures
  std::vector<Tick> x_ticks_, y_ticks_;
  int turned_ = 0;
  double room_below_ = 0;  // of the ticks' texts
  double column_ = 0;      // the width of the column of names, or 0
  bool y_title_on_top_ = false;
  Rect box_{};  // of the plot, before a key is put below it
  std::optional<Board> board_;
  std::vector<Label> labels_;
  std::vector<KeyEntry> key_;
  std::vector<KeyEntry> remarks_;  // on a line above the frame
  std::set<size_t> done_;          // parts that have their name
  std::vector<size_t> ending_right_;
  struct Leader {
    Place from, to;
    MethodStyle style;
  };
  std::vector<Leader> leaders_;  // from ends of curves to the column of names
};

void CurvePlot::set_ranges() {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const Named& part : parts_)
    for (const Curve* curve : part.curves)
      for (const auto& [x, y] : curve->points)
        left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
  const bool any = low <= high;
  // where curves rise from rounding in a moment, the axis begins where they stay
  if (f_.y.logarithmic && any) {
    double stay = 1e300;
    for (const Named& part : parts_)
      for (const Curve* curve : part.curves) {
        std::vector<double> values;
        for (const auto& point : curve->points) values.push_back(point.second);
        std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 5));
        stay = std::min(stay, curve->line && !curve->markers && values.size() > 20 ? values[values.size() / 5] / 3
                                                                                   : *std::ranges::min_element(values));
      }
    low = std::max(low, stay);
  }
  for (const FailureMark& mark : f_.failures) {
    left = std::min(left, mark.x), right = std::max(right, mark.x);
    if (!any) low = std::min(low, mark.y), high = std::max(high, mark.y);
  }
  for (const auto& [x, y] : f_.pareto) left = std::min(left, x), right = std::max(right, x);
  if (f_.cut && f_.y.logarithmic && low < *f_.cut) low = y_floor_ = *f_.cut;
  if (f_.floor && f_.floor->second > low / 30 && f_.floor->second < 30 * high) {
    if (f_.y.logarithmic) low = std::min(low, f_.floor->second);
    high = std::max(high, f_.floor->second);
  }
  for (const Guide& guide : f_.guides)
    if (guide.of_x && f_.x.logarithmic && guide.at > left / 4 && guide.at < right * 4)
      left = std::min(left, guide.at), right = std::max(right, guide.at);
  const auto padded = [](double& a, double& b, bool logarithmic, double part) {
    if (logarithmic) {
      const double factor = std::max(std::pow(b / a, part), 1.05);
      a /= factor, b *= factor;
    } else {
      const double room = b > a ? part * (b - a) : 0.05 * std::abs(b) + 1e-9;
      a -= room, b += room;
    }
  };
  x_low_ = left, x_high_ = right;
  padded(x_low_, x_high_, f_.x.logarithmic, f_.x.logarithmic ? 0.04 : 0.01);
  if (f_.x.low) x_low_ = *f_.x.low;
  if (f_.x.high) x_high_ = *f_.x.high;
  y_low_ = low, y_data_ = high;
  padded(y_low_, y_data_, f_.y.logarithmic, 0.04);
  // an axis goes to where something happens, and no further than the figure asks
  if (f_.y.low && (!f_.y.logarithmic || y_low_ < *f_.y.low)) y_low_ = *f_.y.low;
  if (f_.y.high && (!f_.y.logarithmic || y_data_ > *f_.y.high)) y_data_ = *f_.y.high;
  if (std::isfinite(y_floor_)) y_low_ = y_floor_;
}

/// Crosses stand in rows from the top, in each as many as there is room for.
void CurvePlot::assign_rows() {
  rows_.clear();
  strip_ = 0;
  std::vector<std::vector<double>> taken;
  for (const Named& part : parts_) {
    const auto free = [&](size_t row) {
      return row >= taken.size() || std::ranges::all_of(part.failures, [&](const FailureMark* m) {
               const double x = place(m->x, y_low_).x;
               return std::ranges::none_of(taken[row], [&](double other) { return std::abs(other - x) < 9; });
             });
    };
    if (part.failures.empty()) continue;
    size_t row = 0;
    while (!free(row) && row < 5) ++row;
    if (row >= taken.size()) taken.emplace_back();
    for (const FailureMark* m : part.failures) rows_[m] = row, taken[row].push_back(place(m->x, y_low_).x);
  }
  strip_ = taken.size();
}

/// The box of the plot: its height follows from the figure's width, what stands around it from ticks and titles.
void CurvePlot::frame(double right_column) {
  const double plot_height = (wide_ > 600 ? 0.55 : 0.58) * wide_;
  column_ = right_column;
  y_title_on_top_ = width_of(f_.y.label) > plot_height + 20;
  y_high_ = y_data_;
  y_ticks_ = ticks_of(y_low_, y_data_, f_.y.logarithmic, plot_height, true);
  double widest = 0;
  for (const Tick& t : y_ticks_) widest = std::max(widest, width_of(t.text));
  box_ = {widest + 11 + (y_title_on_top_ || f_.y.label.empty() ? 4 : 19), wide_ - std::max(10., right_column + 4), 0,
          plot_height};
  if (f_.categories.empty())
    frame_numbers();
  else
    frame_categories();
  box_.bottom = room_below_ + (f_.x.label.empty() ? 2 : 17) + 3;
  box_.top = box_.bottom + plot_height;
  assign_rows();
  if (strip_ == 0) return;
  const double part = (11 * static_cast<double>(strip_) + 5) / plot_height, low = scaled(f_.y, y_low_),
               high = low + (scaled(f_.y, y_data_) - low) / (1 - part);
  y_high_ = f_.y.logarithmic ? std::pow(10, high) : high;
}

void CurvePlot::frame_numbers() {
  x_ticks_ = ticks_of(x_low_, x_high_, f_.x.logarithmic, box_.right - box_.left, false);
  room_below_ = 18;
  // no number leaves the sheet
  for (const Tick& t : x_ticks_)
    if (!t.text.empty() && column_ == 0)
      box_.right -= std::max(0., place(t.at, y_low_).x + width_of(t.text) / 2 + 2 - wide_);
}

void CurvePlot::frame_categories() {
  double longest = 0, apart = box_.right - box_.left;
  x_ticks_.clear();
  for (const auto& [at, text] : f_.categories) {
    x_ticks_.push_back({at, reader_name(text)});
    longest = std::max(longest, width_of(x_ticks_.back().text));
  }
  std::ranges::sort(x_ticks_, {}, &Tick::at);
  for (size_t i = 1; i < x_ticks_.size(); ++i)
    apart = std::min(apart, place(x_ticks_[i].at, y_low_).x - place(x_ticks_[i - 1].at, y_low_).x);
  turned_ = longest + 6 < apart ? 0 : apart > 26 ? 35 : apart > 17 ? 60 : 90;
  const double angle = turned_ * std::numbers::pi / 180;
  room_below_ = 6 + std::sin(angle) * longest + std::cos(angle) * letter_height;
  // a turned text reaches left of its tick
  if (turned_ > 0)
    for (const Tick& t : x_ticks_)
      box_.left += std::max(0., 4 + std::cos(angle) * width_of(t.text) - place(t.at, y_low_).x);
}

std::vector<std::vector<Place>> CurvePlot::paths_of(const Named& part) const {
  std::vector<std::vector<Place>> paths;
  for (const Curve* curve : part.curves) {
    paths.emplace_back();
    for (const auto& [x, y] : curve->points) {
      const Place p = place(x, y);
      const bool inside =
          p.x >= box_.left - 1 && p.x <= box_.right + 1 && p.y >= box_.bottom - 1 && p.y <= box_.top + 1;
      if (inside) paths.back().push_back(p);
    }
  }
  std::erase_if(paths, [](const auto& path) { return path.empty(); });
  return paths;
}

std::vector<Place> CurvePlot::crosses_of(const Named& part) const {
  std::vector<Place> all;
  for (const FailureMark* m : part.failures) all.push_back({place(m->x, y_low_).x, y_of_row(rows_.at(m))});
  return all;
}

void CurvePlot::fill_board() {
  board_.emplace(Rect{box_.left + 2, box_.right - 1, box_.bottom + 2, box_.top - 1});
  labels_.clear(), key_.clear(), done_.clear(), leaders_.clear();
  for (const Named& part : parts_) {
    for (const Curve* curve : part.curves) {
      std::vector<Place> path;
      for (const auto& [x, y] : curve->points) path.push_back(place(x, y));
      for (size_t i = 1; i < path.size() && curve->line; ++i) board_->add_line(path[i - 1], path[i], !part.coloured);
      if (curve->markers || !curve->line)
        for (const Place p : path) board_->add_mark(p);
    }
    for (const Place cross : crosses_of(part)) board_->add_mark(cross);
  }
  for (size_t i = 1; i < f_.pareto.size(); ++i) {
    const Place a = place(f_.pareto[i - 1].first, f_.pareto[i - 1].second),
                b = place(f_.pareto[i].first, f_.pareto[i].second);
    board_->add_line(a, {b.x, a.y}, true), board_->add_line({b.x, a.y}, b, true);
  }
  for (const Guide& g : f_.guides)
    if (g.of_x && g.at > x_low_ && g.at < x_high_)
      board_->add_line(place(g.at, y_low_), {place(g.at, y_low_).x, box_.top});
}

double distance(const Rect& r, Place p) {
  return std::hypot(std::max({0., r.left - p.x, p.x - r.right}), std::max({0., r.bottom - p.y, p.y - r.top}));
}

double nearest(const Rect& r, const std::vector<std::vector<Place>>& paths) {
  double least = 1e300;
  for (const auto& path : paths) {
    const size_t stride = 1 + path.size() / 200;
    for (size_t i = 0; i < path.size(); i += stride) least = std::min(least, distance(r, path[i]));
  }
  return least;
}

/// A name at the end of its curve, or along it, or beside a cross of it: where it covers nothing and is nearer to its
/// own curve than to another's.
bool CurvePlot::place_beside(const std::string& words, const std::string& colour,
                             const std::vector<std::vector<Place>>& paths, const std::vector<Place>& marks,
                             const std::vector<std::vector<Place>>& others) {
  const double width = width_of(words), half = 6.2;
  double best = 60;  // worse than this reads worse than a key
  std::optional<Rect> found;
  const auto attempt = [&](double left, double middle, double penalty) {
    const Rect r{left, left + width, middle - half, middle + half};
    const auto covered = board_->cost({r.left - 2, r.right + 2, r.bottom - 1, r.top + 1});
    if (!covered) return;
    double cost = penalty + *covered;
    if (cost >= best) return;
    const double own = std::min(nearest(r, paths), nearest(r, {marks})), other = nearest(r, others);
    if (other < own + 2) cost += 30;
    if (other < 12) cost += 12 - other;
    if (cost < best) best = cost, found = r;
  };
  const auto around = [&](Place p, double penalty, bool right, bool left) {
    for (const double away : {0., 4., 9.}) {
      if (right) attempt(p.x + 7 + away, p.y, penalty + away);
      if (left) attempt(p.x - 7 - away - width, p.y, penalty + 6 + away);
      for (const double side : {1., -1.})
        for (const double shift : {0.5, 0., 1., 0.25, 0.75})
          attempt(p.x - shift * width, p.y + side * (11 + away), penalty + 5 + away + 2 * std::abs(shift - 0.5));
    }
  };
  for (const auto& path : paths) {
    around(path.back(), 0, true, false);
    around(path.front(), 14, false, true);
    const size_t count = std::min<size_t>(path.size(), 24);
    for (size_t k = 1; k < count; ++k)
      around(path[path.size() - 1 - k * path.size() / count], 6 + 0.6 * double(k), false, false);
  }
  for (const Place p : marks) around(p, paths.empty() ? 0 : 30, true, true);
  if (!found) return false;
  labels_.push_back({{found->left, (found->bottom + found->top) / 2}, words, "left", colour});
  board_->add(*found);
  return true;
}

/// Places the names that are not placed yet; false where one that ends at the right found no place, and there is no
/// column of names yet.
bool CurvePlot::place_names() {
  const bool column = column_ > 0;
  std::vector<size_t> missing, order;
  ending_right_.clear();
  long lines = 0;
  for (const bool coloured : {true, false})
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].coloured != coloured) continue;
      order.push_back(i);
      if (!parts_[i].has_line()) continue;
      lines += coloured;
      const auto paths = paths_of(parts_[i]);
      const double edge = box_.right - 0.06 * (box_.right - box_.left);
      if (is_short(parts_[i]) && std::ranges::any_of(paths, [&](const auto& p) { return p.back().x > edge; }))
        ending_right_.push_back(i);
    }
  const bool by_key = lines == 0 && (parts_.size() > 1 || !f_.categories.empty());
  bool others_named = std::ranges::any_of(done_, [&](size_t i) { return !parts_[i].coloured; });
  for (const size_t i : order) {
    const Named& part = parts_[i];
    if (done_.contains(i) || (!part.coloured && others_named)) continue;
    if (!by_key && is_short(part)) {
      std::vector<std::vector<Place>> others;
      for (size_t j = 0; j < parts_.size(); ++j)
        if (j != i && (part.coloured || parts_[j].coloured))
          for (auto& path : paths_of(parts_[j])) others.push_back(std::move(path));
      if (place_beside(part.name, part.coloured ? ink_of(part.style.colour) : grey_ink, paths_of(part),
                       crosses_of(part), others)) {
        done_.insert(i), others_named |= !part.coloured;
        continue;
      }
    }
    if (part.coloured) missing.push_back(i);
  }
  const auto is_coloured = [&](size_t i) { return parts_[i].coloured; };
  const long ends = std::ranges::count_if(ending_right_, is_coloured);
  if (!column && ends > 1 && 2 * ends >= lines &&
      std::ranges::any_of(missing, [&](size_t i) { return std::ranges::count(ending_right_, i) > 0; }))
    return false;
  for (const size_t i : missing) {
    MethodStyle style = parts_[i].style;
    const bool line = parts_[i].has_line();
    if (parts_[i].curves.empty()) style.marker = parts_[i].failures[0]->cross;
    key_.push_back({parts_[i].name, line ? KeyEntry::Kind::line : KeyEntry::Kind::mark, style});
  }
  for (size_t i = 0; i < parts_.size() && !others_named; ++i)
    if (!parts_[i].coloured) {
      others_named = true;
      const bool line = parts_[i].has_line();
      key_.push_back({parts_[i].name,
                      line ? KeyEntry::Kind::line : KeyEntry::Kind::mark,
                      {grey, "1",
                       line                       ? -1
                       : parts_[i].curves.empty() ? 2
                                                  : 6}});
    }
  return true;
}

/// Names right of the plot at the height where their curves end, pushed apart where these lie close.
void CurvePlot::column_of_names() {
  struct Entry {
    size_t part;
    double end, y;
  };
  std::vector<Entry> entries;
  bool others = false;
  for (const size_t i : ending_right_) {
    if (!parts_[i].coloured && std::exchange(others, true)) continue;
    Place end{-1, 0};
    for (const auto& path : paths_of(parts_[i]))
      if (path.back().x > end.x) end = path.back();
    entries.push_back({i, end.y, end.y});
  }
  std::ranges::sort(entries, {}, &Entry::y);
  const double apart = 14, low = box_.bottom + 5, high = box_.top - 5;
  for (int pass = 0; pass < 200; ++pass)
    for (size_t k = 0; k < entries.size(); ++k) {
      if (k > 0 && entries[k].y < entries[k - 1].y + apart) {
        const double push = (entries[k - 1].y + apart - entries[k].y) / 2;
        entries[k].y += push, entries[k - 1].y -= push;
      }
      entries[k].y = std::clamp(entries[k].y, low + apart * static_cast<double>(k),
                                high - apart * static_cast<double>(entries.size() - 1 - k));
    }
  for (const Entry& e : entries) {
    const Named& part = parts_[e.part];
    MethodStyle style = part.coloured ? part.style : MethodStyle{grey, "1", -1};
    leaders_.push_back({{box_.right + 1, e.end}, {box_.right + 9, e.y}, style});
    labels_.push_back({{box_.right + (style.marker > 0 ? 20. : 12.), e.y},
                       part.name,
                       "left",
                       part.coloured ? ink_of(part.style.colour) : grey_ink});
    done_.insert(e.part);
  }
}

/// Names of the lines that are no curves, where they cover nothing.
void CurvePlot::place_lines() {
  const auto beside = [&](double y, const std::string& words, const MethodStyle& style, bool in_key) {
    if (y < box_.bottom || y > box_.top) return;
    const double width = width_of(words), middle = (box_.left + box_.right - width) / 2;
    for (const double side : {1., -1.})
      for (const double left : {box_.right - width - 4, box_.left + 6, middle, (middle + box_.right - width) / 2,
                                (middle + box_.left) / 2}) {
        const Rect r{left, left + width, y + side * 9 - 6.2, y + side * 9 + 6.2};
        if (const auto cost = board_->cost(r); cost && *cost < 3) {
          labels_.push_back({{left, y + side * 9}, words, "left", grey_ink});
          return board_->add(r);
        }
      }
    if (in_key) key_.push_back({words, KeyEntry::Kind::line, style});
  };
  if (f_.floor && f_.floor->second > y_low_ && f_.floor->second < y_data_)
    beside(place(x_low_, f_.floor->second).y, f_.floor->first, {"#777777", "(2,3)", -1}, true);
  bool first = true;
  for (const Guide& g : f_.guides) {
    if (!g.of_x && g.at > y_low_ && g.at < y_data_) {
      const size_t unit = g.text.find(" %");
      beside(place(x_low_, g.at).y, first || unit == std::string::npos ? g.text : g.text.substr(0, unit + 2),
             {"#AAAAAA", "1", -1}, false);
      first = false;
    }
    if (g.of_x && g.at > x_low_ && g.at < x_high_) {
      const double x = place(g.at, y_low_).x, width = width_of(g.text);
      for (const double side : {-1., 1.})
        if (const Rect r{x + side * 9 - 6.2, x + side * 9 + 6.2, box_.bottom + 6, box_.bottom + 6 + width};
            board_->cost(r)) {
          labels_.push_back({{x + side * 9, box_.bottom + 6}, g.text, "left rotate by 90", grey_ink});
          board_->add(r);
          break;
        }
    }
  }
  if (f_.window) {
    const double x = std::max(box_.left, place(f_.window->first, y_low_).x) + 5, width = width_of(f_.window->second);
    bool placed = false;
    for (const double y : {box_.bottom + 10, box_.top - 10})
      if (const Rect r{x, x + width, y - 6.2, y + 6.2}; !placed && board_->cost(r).value_or(99) < 3) {
        labels_.push_back({{x, y}, f_.window->second, "left", grey_ink});
        board_->add(r), placed = true;
      }
    if (!placed) key_.push_back({"from the " + f_.window->second + " on", KeyEntry::Kind::box, {"#E4E4E0", "1", -1}});
  }
  if (!f_.pareto.empty()) {
    std::vector<std::vector<Place>> stairs(1);
    for (const auto& [x, y] : f_.pareto) stairs[0].push_back(place(x, y));
    std::vector<std::vector<Place>> others;
    for (const Named& part : parts_)
      if (part.coloured)
        for (auto& path : paths_of(part)) others.push_back(std::move(path));
    if (!place_beside(pareto_title, grey_ink, stairs, {}, others))
      key_.push_back({pareto_title, KeyEntry::Kind::line, {"#CCCCCC", "1", -1}});
  }
}

/// What crosses mean: beside the last of the first row where there is room, else above the frame.
void CurvePlot::place_kinds() {
  std::map<std::string, std::pair<int, Place>> kinds;  // the cross, and the rightmost of the highest row
  for (const auto& [mark, row] : rows_) {
    const Place at{place(mark->x, y_low_).x, y_of_row(row)};
    const auto [it, is_new] = kinds.try_emplace(kind_of(*mark), mark->cross, at);
    Place& last = it->second.second;
    if (!is_new && (at.y > last.y + 1 || (std::abs(at.y - last.y) < 1 && at.x > last.x))) last = at;
  }
  for (const auto& [kind, cross] : kinds) {
    const double width = width_of(kind);
    const Place at{cross.second.x + 8, cross.second.y};
    const Rect r{at.x, at.x + width, at.y - 5, at.y + 5};
    if (kinds.size() == 1 && board_->cost(r)) {
      labels_.push_back({at, kind, "left", "#444444"});
      board_->add(r);
    } else {
      remarks_.push_back({kind, KeyEntry::Kind::mark, {"#444444", "1", cross.first}});
    }
  }
  for (const Curve& curve : f_.curves)
    if (curve.title == scaled_times && !curve.points.empty())
      remarks_.push_back({"time scaled from a part", KeyEntry::Kind::mark, {"#444444", "1", 6}});
  const auto lower = [&](const Curve* c) {
    return std::ranges::any_of(c->points, [&](const auto& p) { return p.second < y_floor_; });
  };
  if (std::ranges::any_of(parts_, [&](const Named& n) { return std::ranges::any_of(n.curves, lower); }))
    remarks_.push_back({"lower than the axis", KeyEntry::Kind::mark, {"#444444", "1", 11}});
}

/// The plot command: the rows of each curve from the file.
std::string CurvePlot::elements() const {
  std::vector<std::string> parts;
  const auto rows = [&](const std::string& curve, const std::string& y) {
    return fmt::format("{} using (strcol(1) eq {} ? $2 : NaN):{} with ", single_quoted(f_.name + ".csv"),
                       single_quoted(id_of(curve)), y);
  };
  const std::string y = std::isfinite(y_floor_) ? fmt::format("($3 < {0:.6g} ? {0:.6g} : $3)", y_floor_) : "3";
  if (!f_.pareto.empty()) parts.push_back(rows(pareto_title, y) + "steps lw 6 lc rgb \"#DDDDDD\"");
  const auto draw = [&](const Named& part, const Curve& c) {
    const std::string colour = part.coloured ? c.style.colour : grey;
    const double size = part.coloured ? 0.75 : 0.5;
    const int gap = c.markers ? 1 : std::max<int>(1, static_cast<int>(c.points.size()) / 8);
    const bool line = c.line && c.points.size() > 1,
               marks = c.style.marker > 0 && (part.coloured || c.markers || !c.line);
    if (line || marks)
      parts.push_back(rows(c.title, y) + fmt::format("{} lc rgb \"{}\"",
                                                     line && marks ? "linespoints"
                                                     : line        ? "lines"
                                                                   : "points",
                                                     colour));
    if (line) parts.back() += fmt::format(" lw {} dt {}", part.coloured ? 2 : 1, part.coloured ? c.style.dash : "1");
    if (marks) parts.back() += fmt::format(" pt {} ps {} pointinterval {}", c.style.marker, size, gap);
    if (std::isfinite(y_floor_) && std::ranges::any_of(c.points, [&](const auto& p) { return p.second < y_floor_; }))
      parts.push_back(
          rows(c.title, fmt::format("($3 < {0:.6g} ? {1:.6g} : NaN)", y_floor_, value_at(box_.bottom + 4))) +
          fmt::format("points lc rgb \"{}\" pt 11 ps 0.9", colour));
  };
  for (const bool coloured : {false, true})
    for (auto part = parts_.rbegin(); part != parts_.rend(); ++part)
      if (part->coloured == coloured)
        for (const Curve* c : part->curves) draw(*part, *c);
  for (const Curve& c : f_.curves)  // open marks
    if (c.title == scaled_times && !c.points.empty())
      parts.push_back(rows(c.title, y) + "points pt 7 ps 0.4 lc rgb \"#FFFFFF\"");
  std::set<std::string> marked;
  for (const Named& part : parts_)
    for (const FailureMark* m : part.failures)
      if (marked.insert(m->title).second)
        parts.push_back(
            rows("failed: " + m->title, fmt::format("({:.6g})", value_at(y_of_row(rows_.at(m))))) +
            fmt::format("points lc rgb \"{}\" pt {} ps 0.9 lw 2.2", part.coloured ? m->style.colour : grey, m->cross));
  std::string out = "plot ";
  for (size_t i = 0; i < parts.size(); ++i) out += (i ? " notitle, \\\n     " : "") + parts[i];
  return out + " notitle\n";
}

std::string CurvePlot::script() const {
  const double key = key_.empty() ? 0 : key_height(key_, wide_ - 16) + 4,
               remarks = remarks_.empty() ? 0 : key_height(remarks_, wide_ - 30) + 2, title = f_.size.titled ? 20 : 0,
               y_title = y_title_on_top_ ? 17 : 0;
  const double tall = key + box_.top + remarks + y_title + title + (remarks + y_title + title > 0 ? 3 : 8);
  const Sheet sheet(wide_, tall, key);
  std::string out = script_head(f_) + sheet.margins(box_) + "unset key\n";
  out += fmt::format("set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n", x_low_, x_high_, y_low_, y_high_);
  for (const auto& [axis, letter] : {std::pair{&f_.x, "x"}, {&f_.y, "y"}})
    if (axis->logarithmic) out += fmt::format("set logscale {} 10\n", letter);
  std::vector<Tick> x_ticks = x_ticks_;
  if (turned_ > 0)
    for (Tick& t : x_ticks)
      out += sheet.text({place(t.at, y_low_).x + 3, box_.bottom - 9}, std::exchange(t.text, " "), "right", "#222222",
                        fmt::format("rotate by {}", turned_));
  out += tick_command("x", x_ticks) + tick_command("y", y_ticks_) + "set grid noxtics noytics\n";
  const std::string black = "#111111";
  double above = box_.top + 3;
  if (!remarks_.empty()) above += remarks, out += key_commands(sheet, remarks_, {22, above}, wide_ - 30);
  if (y_title_on_top_)
    out += sheet.text({6, above + 8}, shortened(f_.y.label, wide_ - 12), "left", black), above += y_title;
  else if (!f_.y.label.empty())
    out += sheet.text({9, std::min((box_.bottom + box_.top) / 2, tall - key - width_of(f_.y.label) / 2 - 2)},
                      f_.y.label, "center rotate by 90", black);
  out += title_command(sheet, f_, {wide_ / 2, above + 10});
  if (!f_.x.label.empty()) {
    // what is scaled has open marks
    const std::string label =
        f_.x.label.find(", ringed") == std::string::npos
            ? f_.x.label
            : f_.x.label.substr(0, f_.x.label.find(", ringed")) + f_.x.label.substr(f_.x.label.rfind(" / "));
    const double half = width_of(label) / 2;
    out += sheet.text(
        {std::clamp((box_.left + box_.right) / 2, std::min(half + 4, wide_ / 2), std::max(wide_ - half - 4, wide_ / 2)),
         box_.bottom - room_below_ - 11},
        shortened(label, wide_ - 8), "center", black);
  }
  if (!key_.empty()) out += key_commands(sheet, key_, {8, -2}, wide_ - 16);
  if (f_.window)
    out += fmt::format(
        "set object rectangle from {:.6g}, graph 0 to graph 1, graph 1 fc rgb \"#F1F1EE\" fs solid noborder behind\n",
        f_.window->first);
  for (const Guide& g : f_.guides) {
    const Place at = place(g.of_x ? g.at : x_low_, g.of_x ? y_low_ : g.at);
    if (g.of_x && g.at > x_low_ && g.at < x_high_)
      out += sheet.line({at.x, box_.bottom}, {at.x, box_.top}, "#444444", 1.5, "(1,3)");
    if (!g.of_x && g.at > y_low_ && g.at < y_data_)
      out += sheet.line({box_.left, at.y}, {box_.right, at.y}, "#BBBBBB", 1, "1");
  }
  if (f_.floor && f_.floor->second > y_low_ && f_.floor->second < y_data_)
    out += sheet.line({box_.left, place(x_low_, f_.floor->second).y}, {box_.right, place(x_low_, f_.floor->second).y},
                      "#777777", 1.2, "(2,3)");
  for (const Leader& leader : leaders_) {
    out += sheet.line(leader.from, leader.to, leader.style.colour, 1, "1");
    if (leader.style.marker > 0)
      out += sheet.mark({leader.to.x + 5, leader.to.y}, leader.style.colour, leader.style.marker);
  }
  for (const Label& label : labels_) out += sheet.text(label.at, label.words, label.align, label.colour);
  return out + terminals(f_, tall, elements());
}

}  // namespace

Drawing drawing_of(const Figure& figure) {
  Table data = data_of(figure);
  return {figure.name, std::move(data), CurvePlot(figure).script()};
}

}  // namespace crosscheck
