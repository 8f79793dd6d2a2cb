#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/base/gnuplot.h"
#include "report/figures/plot_layout.h"

namespace crosscheck {
namespace {

Table data_of(const StackedBars& bars) {
  Table table{
      bars.name, {{"part", "1"}, {"name", "1"}, {"place", "1"}, {"from", "see label"}, {"to", "see label"}}, {}};
  std::vector<double> up(bars.names.size(), 0), down(bars.names.size(), 0);
  for (const StackedBars::Part& part : bars.parts)
    for (size_t i = 0; i < bars.names.size(); ++i) {
      const double height = part.height.at(i);
      if (height == 0) continue;
      double& at = height > 0 ? up[i] : down[i];
      table.add({part.title, bars.names[i], static_cast<double>(i + 1), at, at + height});
      at += height;
    }
  return checked(std::move(table));
}

}  // namespace

Drawing drawing_of(const StackedBars& bars) {
  Drawing drawing{bars.name, data_of(bars), ""};
  std::vector<KeyEntry> key;
  std::vector<std::string> parts;
  double low = 0, high = 0;
  for (size_t i = 0; i < drawing.data.rows.size(); ++i)
    low = std::min(low, std::get<double>(drawing.data.at(i, "to"))),
    high = std::max(high, std::get<double>(drawing.data.at(i, "to")));
  for (const StackedBars::Part& part : bars.parts) {
    if (std::ranges::all_of(part.height, [](double height) { return height == 0; })) continue;
    const std::string fill = part.hatched ? "transparent pattern 4" : "solid";
    key.push_back({part.title, KeyEntry::Kind::box, {part.colour, "1", -1}, fill});
    parts.push_back(fmt::format(
        "{} using (strcol(1) eq {} ? $4 : NaN):3:4:5:($3-0.36):($3+0.36) with boxxyerror lc rgb \"{}\" fs {} border "
        "lc rgb \"{}\" notitle",
        single_quoted(bars.name + ".csv"), single_quoted(part.title), part.colour, fill,
        part.hatched ? part.colour : "#FFFFFF"));
  }
  const double lines = static_cast<double>(bars.names.size()), room = 0.03 * (high - low);
  const NamedLines layout(bars, bars.label, bars.names, lines, key);
  low -= low < 0 ? room : 0, high += room;
  std::string out = script_head(bars) + fmt::format("set xrange [{:.8g}:{:.8g}]\n", low, high) + layout.y_range(lines) +
                    "set yzeroaxis lt 1 lc rgb \"#333333\" lw 1.5\n" +
                    layout.commands(bars, ticks_of(low, high, false, layout.box.right - layout.box.left, false));
  for (size_t i = 0; i < bars.names.size(); ++i) out += layout.name(static_cast<double>(i + 1), i);
  drawing.script = out + terminals(bars, layout.tall, joined_plot(parts));
  return drawing;
}

namespace {

/// Vertical position of a line, in lines. Each heading above it takes an extra line, as does the label `right_of_one`.
double place_of(const DotPlot& dots, size_t line) {
  const auto above = std::count_if(dots.headings.begin(), dots.headings.end(),
                                   [&](const auto& heading) { return heading.first <= line; });
  return static_cast<double>(line + 1 + !dots.right_of_one.empty()) + static_cast<double>(above);
}

Table data_of(const DotPlot& dots) {
  Table table{
      dots.name, {{"series", "1"}, {"name", "1"}, {"place", "1"}, {"value", "1"}, {"low", "1"}, {"high", "1"}}, {}};
  for (const DotPlot::Series& series : dots.series)
    for (size_t i = 0; i < dots.names.size(); ++i) {
      const auto& dot = series.dots.at(i);
      if (!dot) continue;
      for (const double value : {dot->value, dot->low, dot->high})
        if (!(value > 0)) throw std::runtime_error(fmt::format("figure {}: a value is not above zero", dots.name));
      table.add({series.title, dots.names[i], place_of(dots, i), dot->value, dot->low, dot->high});
    }
  return checked(std::move(table));
}

/// Offset of a series from the middle of its line, so that series do not hide each other.
double offset_of(size_t series, size_t count) {
  return count < 2 ? 0 : 0.3 * (static_cast<double>(series) / static_cast<double>(count - 1) - 0.5);
}

}  // namespace

Drawing drawing_of(const DotPlot& dots) {
  Drawing drawing{dots.name, data_of(dots), ""};
  std::vector<KeyEntry> key;
  std::vector<std::string> parts;
  const bool ratios = !dots.right_of_one.empty();
  double low = ratios ? 1 : INFINITY, high = ratios ? 1 : 0;
  std::vector<std::string> titles;
  for (const DotPlot::Series& series : dots.series) titles.push_back(series.title);
  for (size_t i = 0; i < dots.series.size(); ++i) {
    const DotPlot::Series& series = dots.series[i];
    if (std::ranges::none_of(series.dots, [](const auto& dot) { return dot.has_value(); })) continue;
    for (const auto& dot : series.dots)
      if (dot) low = std::min(low, dot->low), high = std::max(high, dot->high);
    key.push_back({reader_name(series.title, titles), KeyEntry::Kind::mark, series.style});
    parts.push_back(fmt::format(
        "{} using (strcol(1) eq {} ? $4 : NaN):($3 + {:.3g}):5:6 with xerrorbars lc rgb \"{}\" pt {} ps 0.8 lw 1.5 "
        "notitle",
        single_quoted(dots.name + ".csv"), single_quoted(series.title), offset_of(i, dots.series.size()),
        series.style.colour, series.style.marker));
  }
  low /= 1.3, high *= 1.3;
  const double lines = static_cast<double>(dots.names.size() + dots.headings.size() + ratios);
  const NamedLines layout(dots, dots.label, dots.names, lines, key);
  std::string out = script_head(dots) + fmt::format("set logscale x 10\nset xrange [{:.8g}:{:.8g}]\n", low, high) +
                    layout.y_range(lines) +
                    layout.commands(dots, ticks_of(low, high, true, layout.box.right - layout.box.left, false));
  if (ratios)
    out += fmt::format(
        "set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb \"#333333\" lw 1.5 back\n"
        "set label {} at 1, 1 left offset 0.5,0 noenhanced tc rgb \"#333333\"\n",
        single_quoted(dots.right_of_one + " →"));
  for (size_t i = 0; i < dots.names.size(); ++i) out += layout.name(place_of(dots, i), i);
  for (const auto& [line, heading] : dots.headings) out += layout.heading(place_of(dots, line) - 1, heading);
  drawing.script = out + terminals(dots, layout.tall, joined_plot(parts));
  return drawing;
}

}  // namespace crosscheck
