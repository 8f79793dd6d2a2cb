// Stacked bars, and dots with intervals: figures with one line for each name.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "report/figures/figure.h"

namespace crosscheck {
namespace {

Table data_of(const StackedBars& bars) {
  Table table{
      bars.name, {{"part", "1"}, {"name", "1"}, {"place", "1"}, {"from", "see label"}, {"to", "see label"}}, {}};
  std::vector<double> up(bars.names.size(), 0), down(bars.names.size(), 0);
  for (const StackedBars::Part& part : bars.parts)
    for (size_t i = 0; i < bars.names.size(); ++i) {
      const double height = part.height.at(i);
      if (!std::isfinite(height)) throw std::runtime_error(fmt::format("figure {}: a value is not finite", bars.name));
      if (height == 0) continue;
      double& at = height > 0 ? up[i] : down[i];
      table.add({part.title, bars.names[i], static_cast<double>(i + 1), at, at + height});
      at += height;
    }
  if (table.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", bars.name));
  return table;
}

}  // namespace

Drawing drawing_of(const StackedBars& bars) {
  Drawing drawing{bars.name, data_of(bars), ""};
  std::string out = fmt::format("# {}\n# Draw again: gnuplot {}.gp\nreset\nload \"style.gp\"\n", bars.title, bars.name);
  out += title_command(bars);
  out += axis_commands({bars.label}, "x");
  out += fmt::format("set yrange [{:.1f}:0.4]\nset yzeroaxis lt 1 lc rgb \"#333333\" lw 1.5\nset grid noytics\n",
                     static_cast<double>(bars.names.size()) + 0.6);
  out += "set ytics noenhanced (";
  for (size_t i = 0; i < bars.names.size(); ++i)
    out += fmt::format("{}{} {}", i ? ", " : "", single_quoted(bars.names[i]), i + 1);
  out += ")\n";
  std::string plot;
  for (const StackedBars::Part& part : bars.parts) {
    bool any = false;
    for (const double height : part.height) any |= height != 0;
    if (!any) continue;
    plot += fmt::format(
        "{}{} using (strcol(1) eq {} ? $4 : NaN):3:4:5:($3-0.36):($3+0.36) with boxxyerror lc rgb \"{}\" fs {} border "
        "lc rgb \"{}\" title {}",
        plot.empty() ? "plot " : ", \\\n     ", single_quoted(bars.name + ".csv"), single_quoted(part.title),
        part.colour, part.hatched ? "transparent pattern 4" : "solid 0.85", part.colour, single_quoted(part.title));
  }
  drawing.script = out + terminals(bars, 0.45 + 0.06 * static_cast<double>(bars.names.size()), plot + "\n");
  return drawing;
}

namespace {

/// Where a line stands: headings take lines of their own.
double place_of(const DotPlot& dots, size_t line) {
  const auto above = std::count_if(dots.headings.begin(), dots.headings.end(),
                                   [&](const auto& heading) { return heading.first <= line; });
  return static_cast<double>(line + 1) + static_cast<double>(above);
}

Table data_of(const DotPlot& dots) {
  Table table{
      dots.name, {{"series", "1"}, {"name", "1"}, {"place", "1"}, {"value", "1"}, {"low", "1"}, {"high", "1"}}, {}};
  for (const DotPlot::Series& series : dots.series)
    for (size_t i = 0; i < dots.names.size(); ++i) {
      const auto& dot = series.dots.at(i);
      if (!dot) continue;
      for (const double value : {dot->value, dot->low, dot->high})
        if (!(value > 0) || !std::isfinite(value))
          throw std::runtime_error(fmt::format("figure {}: a value is not above zero", dots.name));
      table.add({series.title, dots.names[i], place_of(dots, i), dot->value, dot->low, dot->high});
    }
  if (table.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", dots.name));
  return table;
}

constexpr double letter_width = 7.3;  // mean width of a letter of 12 units, in units

/// The share of the width for the longest name or heading.
double room_for_names(const DotPlot& dots) {
  size_t longest = 0;
  for (const std::string& name : dots.names) longest = std::max(longest, name.size());
  for (const auto& [line, heading] : dots.headings) longest = std::max(longest, heading.size());
  return std::min(0.5, 0.04 + letter_width * static_cast<double>(longest) / dots.size.units());
}

bool drawn(const DotPlot::Series& series) {
  return std::any_of(series.dots.begin(), series.dots.end(), [](const auto& dot) { return dot.has_value(); });
}

/// Lines of the key below the plot, where gnuplot sets as many entries side by side as there is room for.
double rows_of_key(const DotPlot& dots) {
  size_t entries = 0, longest = 0;
  for (const DotPlot::Series& series : dots.series)
    if (drawn(series)) ++entries, longest = std::max(longest, series.title.size());
  const double side_by_side = std::floor(dots.size.units() / (60 + letter_width * static_cast<double>(longest)));
  return std::ceil(static_cast<double>(entries) / std::max(1., side_by_side));
}

/// The height for terminals(): lines of 17 units and more, and what title, numbers, label and key take.
double tall(const DotPlot& dots) {
  const double wide = dots.size.units() / 680, line = 17 + 9 * std::min(1., wide),
               height = (dots.size.titled ? 30 : 10) + 62 + 21 * rows_of_key(dots) +
                        line * static_cast<double>(dots.names.size() + dots.headings.size());
  return 1 + (height - 140 - 360 * wide) / 500;
}

/// The series lie a little above and below the middle of their line, so that they do not hide each other.
double offset_of(size_t series, size_t count) {
  return count < 2 ? 0 : 0.3 * (static_cast<double>(series) / static_cast<double>(count - 1) - 0.5);
}

/// The logarithmic axis, with ticks at 1, 2, 5 and so on, or over many decades at powers of ten alone.
std::string axis_of(const DotPlot& dots) {
  double least = 1, most = 1;
  for (const DotPlot::Series& series : dots.series)
    for (const auto& dot : series.dots)
      if (dot) least = std::min(least, dot->low), most = std::max(most, dot->high);
  least /= 1.3, most *= 1.3;
  std::string ticks;
  for (int power = -6; power <= 9; ++power)
    for (const double digit : {1, 2, 5}) {
      const double tick = digit * std::pow(10, power);
      if (tick < least || tick > most || (digit > 1 && most > 200 * least)) continue;
      ticks += fmt::format("{}{:.6g}", ticks.empty() ? "" : ", ", tick);
    }
  return fmt::format("set logscale x 10\nset format x \"%g\"\nset xrange [{:.6g}:{:.6g}]\nset xtics ({})\n", least,
                     most, ticks);
}

}  // namespace

Drawing drawing_of(const DotPlot& dots) {
  Drawing drawing{dots.name, data_of(dots), ""};
  std::string out = fmt::format("# {}\n# Draw again: gnuplot {}.gp\nreset\nload \"style.gp\"\n", dots.title, dots.name);
  // next to the names title and key stand in the middle of the figure, not of the plot
  if (dots.size.titled)
    out += fmt::format(
        "set title ' '\nset label {} at screen 0.5, screen 1 offset 0,-1.2 center noenhanced font \"DejaVu "
        "Sans:Bold,13\"\n",
        single_quoted(dots.title));
  out += fmt::format(
      "set key at screen 0.5, screen 0 center bottom horizontal\nset lmargin at screen {:.3f}\nset bmargin {:.2f}\n"
      "set xlabel {} offset 0,0.2\n",
      room_for_names(dots), 4.2 + 1.4 * rows_of_key(dots), single_quoted(dots.label));
  out += axis_of(dots);
  const double lines = static_cast<double>(dots.names.size() + dots.headings.size());
  out += fmt::format("set yrange [{:.1f}:0.4]\nset ytics noenhanced (", lines + 0.6);
  for (size_t i = 0; i < dots.names.size(); ++i)
    out += fmt::format("{}{} {:g}", i ? ", " : "", single_quoted(dots.names[i]), place_of(dots, i));
  out += ")\nset arrow from 1, graph 0 to 1, graph 1 nohead lc rgb \"#333333\" lw 1.5 back\n";
  for (const auto& [line, heading] : dots.headings)
    out += fmt::format("set label {} at screen 0.02, first {:g} left noenhanced font \"DejaVu Sans:Bold,11\"\n",
                       single_quoted(heading), place_of(dots, line) - 1);
  std::string plot;
  for (size_t i = 0; i < dots.series.size(); ++i) {
    const DotPlot::Series& series = dots.series[i];
    if (!drawn(series)) continue;
    plot += fmt::format(
        "{}{} using (strcol(1) eq {} ? $4 : NaN):($3 + {:.3g}):5:6 with xerrorbars lc rgb \"{}\" pt {} ps 1 lw 2 title "
        "{}",
        plot.empty() ? "plot " : ", \\\n     ", single_quoted(dots.name + ".csv"), single_quoted(series.title),
        offset_of(i, dots.series.size()), series.style.colour, series.style.marker, single_quoted(series.title));
  }
  drawing.script = out + terminals(dots, tall(dots), plot + "\n");
  return drawing;
}

}  // namespace crosscheck
