// Curves in the style of journals: names next to the curves, at most six in colour, the others grey, and failures in a
// strip along the top.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "mysim/base/names.h"
#include "reference/method.h"
#include "report/base/gnuplot.h"
#include "report/figures/curve_plot.h"

namespace crosscheck {
namespace {

constexpr size_t most_in_colour = 6;

/// Name of a curve in the data file, where gnuplot splits even quoted fields at commas.
std::string id_of(std::string title) {
  for (char& c : title)
    if (c == ',' || c == '"') c = ';';
  return title;
}

Table data_of(const Figure& f) {
  Table table{f.name, {{"curve", "1"}, {f.x.label, "see name"}, {f.y.label, "see name"}}, {}};
  const auto add = [&](const std::string& curve, double x, double y) { table.add({id_of(curve), x, y}); };
  for (const auto& [x, y] : f.pareto) add(pareto_title, x, y);
  for (const Curve& curve : f.curves)
    for (const auto& [x, y] : curve.points) add(curve.title, x, y);
  for (const FailureMark& mark : f.failures) add("failed: " + mark.title, mark.x, mark.y);
  return checked(std::move(table));
}

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

/// Priority for colours, in this order: curves that are not methods; representative and position-based methods; other
/// methods of these engines; integrators; all other methods.
int place_in_line(const NamedCurves& named) {
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

bool has_recommended_run(const Figure& f, const NamedCurves& named) {
  const auto& take = f.on_page.take;
  return take && std::ranges::any_of(named.curves, [&](const Curve* c) {
           return std::ranges::find(c->points, std::pair(take->x, take->y)) != c->points.end();
         });
}

}  // namespace

std::vector<NamedCurves> named_parts(const Figure& f) {
  std::vector<NamedCurves> all;
  for (const Curve& curve : f.curves) {
    if (curve.points.empty() || curve.title == scaled_times) continue;
    const std::string method = method_named(curve.title);
    auto it = std::ranges::find_if(all, [&](const NamedCurves& n) {
      return n.style.colour == curve.style.colour &&
             (method.empty() ? common_words(n.title, curve.title).size() > 3 : method == method_named(n.title));
    });
    if (it == all.end())
      it = all.insert(all.end(), {curve.title, "", curve.style, {}, {}});
    else if (const std::string common = common_words(it->title, curve.title); !common.empty() || method.empty())
      it->title = common;
    else
      it->title = method;
    if (it->style.marker < 0) it->style.marker = curve.style.marker;
    it->curves.push_back(&curve);
  }
  for (const FailureMark& mark : f.failures) {
    const std::string method = method_named(mark.title);
    auto it = std::ranges::find_if(all, [&](const NamedCurves& n) {
      return n.style.colour == mark.style.colour &&
             (method.empty() ? mark.title.starts_with(n.title) : method == method_named(n.title));
    });
    if (it == all.end())
      it = all.insert(all.end(), {mark.title.substr(0, mark.title.rfind(": ")), "", mark.style, {}, {}});
    it->failures.push_back(&mark);
  }
  std::vector<size_t> order(all.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {},
                           [&](size_t i) { return has_recommended_run(f, all[i]) ? -1 : place_in_line(all[i]); });
  for (size_t i = 0; i < std::min(order.size(), most_in_colour); ++i) all[order[i]].coloured = true;
  const auto left = std::ranges::count_if(all, [](const NamedCurves& n) { return !n.coloured; });
  std::vector<std::string> titles;
  for (const NamedCurves& n : all) titles.push_back(n.title);
  for (NamedCurves& n : all)
    n.name = n.coloured || left == 1 ? reader_name(n.title, titles) : fmt::format("{} others", left);
  return all;
}

PlotRange plot_range(const Figure& f, const std::vector<NamedCurves>& parts) {
  PlotRange range{};
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const NamedCurves& part : parts)
    for (const Curve* curve : part.curves)
      for (const auto& [x, y] : curve->points)
        left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
  const bool any = low <= high;
  // skip initial rises from round-off: begin the axis where curves settle
  if (f.y.logarithmic && any) {
    double stay = 1e300;
    for (const NamedCurves& part : parts)
      for (const Curve* curve : part.curves) {
        std::vector<double> values;
        for (const auto& point : curve->points) values.push_back(point.second);
        std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 5));
        stay = std::min(stay, curve->line && !curve->markers && values.size() > 20 ? values[values.size() / 5] / 3
                                                                                   : *std::ranges::min_element(values));
      }
    low = std::max(low, stay);
  }
  for (const FailureMark& mark : f.failures) {
    left = std::min(left, mark.x), right = std::max(right, mark.x);
    if (!any) low = std::min(low, mark.y), high = std::max(high, mark.y);
  }
  for (const auto& [x, y] : f.pareto) left = std::min(left, x), right = std::max(right, x);
  if (f.cut && f.y.logarithmic && low < *f.cut) low = range.y_floor = *f.cut;
  if (f.floor && f.floor->second > low / 30 && f.floor->second < 30 * high) {
    if (f.y.logarithmic) low = std::min(low, f.floor->second);
    high = std::max(high, f.floor->second);
  }
  for (const Guide& guide : f.guides)
    if (guide.of_x && f.x.logarithmic && guide.at > left / 4 && guide.at < right * 4)
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
  range.x_low = left, range.x_high = right;
  padded(range.x_low, range.x_high, f.x.logarithmic, f.x.logarithmic ? 0.04 : 0.01);
  if (f.x.low) range.x_low = *f.x.low;
  if (f.x.high) range.x_high = *f.x.high;
  range.y_low = low, range.y_high = high;
  padded(range.y_low, range.y_high, f.y.logarithmic, 0.04);
  if (f.y.low && (!f.y.logarithmic || range.y_low < *f.y.low)) range.y_low = *f.y.low;
  if (f.y.high && (!f.y.logarithmic || range.y_high > *f.y.high)) range.y_high = *f.y.high;
  if (std::isfinite(range.y_floor)) range.y_low = range.y_floor;
  return range;
}

bool named_in_key(const Figure& f, const std::vector<NamedCurves>& parts, const NamedCurves& part) {
  if (parts.size() < 2 && f.categories.empty()) return false;
  if (std::ranges::none_of(parts, [](const NamedCurves& n) { return n.coloured && n.has_line(); })) return true;
  return !part.curves.empty() && std::ranges::none_of(part.curves, [](const Curve* c) { return c->line; });
}

std::optional<Place> CurvePlot::sign_of(const NamedCurves& part, size_t row) const {
  if (!part.coloured || part.style.marker <= 0 || part.failures.empty() ||
      std::ranges::count_if(parts_, [](const NamedCurves& n) { return !n.failures.empty(); }) < 2)
    return {};
  double left = 1e300, right = -1e300;
  for (const FailureMark* m : part.failures) {
    const double x = place(m->x, y_low_).x;
    left = std::min(left, x), right = std::max(right, x);
  }
  return Place{left - 11 > box_.left + 5 ? left - 11 : right + 11, y_of_row(row)};
}

/// Fills the rows of crosses from the top.
void CurvePlot::assign_rows() {
  rows_.clear();
  strip_ = 0;
  std::vector<std::vector<double>> taken;
  for (const NamedCurves& part : parts_) {
    std::vector<double> all;
    for (const FailureMark* m : part.failures) all.push_back(place(m->x, y_low_).x);
    if (const auto sign = sign_of(part, 0)) all.push_back(sign->x);
    const auto free = [&](size_t row) {
      return row >= taken.size() || std::ranges::all_of(all, [&](double x) {
               return std::ranges::none_of(taken[row], [&](double other) { return std::abs(other - x) < 9; });
             });
    };
    if (part.failures.empty()) continue;
    size_t row = 0;
    while (!free(row) && row < 5) ++row;
    if (row >= taken.size()) taken.emplace_back();
    for (const FailureMark* m : part.failures) rows_[m] = row;
    taken[row].insert(taken[row].end(), all.begin(), all.end());
  }
  strip_ = taken.size();
}

/// Sets the box of the plot: its height from the figure's width, and its margins from ticks and titles.
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
  for (const Tick& t : x_ticks_)
    if (!t.text.empty() && column_ == 0)
      box_.right -= std::max(0., place(t.at, y_low_).x + width_of(t.text) / 2 + 2 - wide_);
}

void CurvePlot::frame_categories() {
  double longest = 0, apart = box_.right - box_.left;
  x_ticks_.clear();
  std::vector<std::string> texts;
  for (const auto& [at, text] : f_.categories) texts.push_back(text);
  for (const auto& [at, text] : f_.categories) {
    std::string name = reader_name(text, texts);
    if (width_of(name) > wide_ / 2) {  // leave room for the plot
      do name.pop_back();
      while (!is_printable(name) || width_of(name + "…") > wide_ / 2);
      name += "…";
    }
    x_ticks_.push_back({at, name});
    longest = std::max(longest, width_of(x_ticks_.back().text));
  }
  std::ranges::sort(x_ticks_, {}, &Tick::at);
  for (size_t i = 1; i < x_ticks_.size(); ++i)
    apart = std::min(apart, place(x_ticks_[i].at, y_low_).x - place(x_ticks_[i - 1].at, y_low_).x);
  turned_ = longest + 6 < apart ? 0 : apart > 26 ? 35 : apart > 17 ? 60 : 90;
  const double angle = turned_ * std::numbers::pi / 180;
  room_below_ = 6 + std::sin(angle) * longest + std::cos(angle) * letter_height;
  // a rotated label extends to the left
  if (turned_ > 0)
    for (const Tick& t : x_ticks_)
      box_.left += std::max(0., 4 + std::cos(angle) * width_of(t.text) - place(t.at, y_low_).x);
}
/// Returns the plot command, which selects each curve's rows by name.
std::string CurvePlot::elements() const {
  std::vector<std::string> parts;
  const auto rows = [&](const std::string& curve, const std::string& y) {
    return fmt::format("{} using (strcol(1) eq {} ? $2 : NaN):{} with ", single_quoted(f_.name + ".csv"),
                       single_quoted(id_of(curve)), y);
  };
  const std::string y = std::isfinite(y_floor_) ? fmt::format("($3 < {0:.6g} ? {0:.6g} : $3)", y_floor_) : "3";
  if (!f_.pareto.empty()) parts.push_back(rows(pareto_title, y) + "steps lw 6 lc rgb \"#DDDDDD\"");
  const auto draw = [&](const NamedCurves& part, const Curve& c) {
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
  for (const Curve& c : f_.curves)  // white centres of open marks
    if (c.title == scaled_times && !c.points.empty())
      parts.push_back(rows(c.title, y) + "points pt 7 ps 0.4 lc rgb \"#FFFFFF\"");
  std::set<std::string> marked;
  for (const NamedCurves& part : parts_)
    for (const FailureMark* m : part.failures)
      if (marked.insert(m->title).second)
        parts.push_back(
            rows("failed: " + m->title, fmt::format("({:.6g})", value_at(y_of_row(rows_.at(m))))) +
            fmt::format("points lc rgb \"{}\" pt {} ps 0.9 lw 2.2", part.coloured ? m->style.colour : grey, m->cross));
  for (std::string& part : parts) part += " notitle";
  return joined_plot(parts);
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
    // times scaled from a part of the run have open marks
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
  for (const NamedCurves& part : parts_)
    if (const auto sign = part.failures.empty() ? std::nullopt : sign_of(part, rows_.at(part.failures[0])))
      out += sheet.mark(*sign, part.style.colour, part.style.marker, 0.6);
  for (const Label& label : labels_) out += sheet.text(label.at, label.words, label.align, label.colour);
  return out + terminals(f_, tall, elements());
}

Drawing drawing_of(const Figure& figure) {
  Table data = data_of(figure);
  return {figure.name, std::move(data), CurvePlot(figure).script()};
}

}  // namespace crosscheck
