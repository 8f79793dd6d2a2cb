#include "report/dots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crosscheck {
namespace {

Table data_of(const Dots& dots) {
  Table table{
      dots.name, {{"series", "1"}, {"name", "1"}, {"place", "1"}, {"value", "1"}, {"low", "1"}, {"high", "1"}}, {}};
  for (const Dots::Series& series : dots.series)
    for (size_t i = 0; i < dots.names.size(); ++i) {
      const auto& dot = series.dots.at(i);
      if (!dot) continue;
      for (const double value : {dot->value, dot->low, dot->high})
        if (!(value > 0) || !std::isfinite(value))
          throw std::runtime_error(fmt::format("figure {}: a value is not above zero", dots.name));
      table.add({series.title, dots.names[i], static_cast<double>(i + 1), dot->value, dot->low, dot->high});
    }
  if (table.rows.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", dots.name));
  return table;
}

/// The series lie a little above and below the middle of their line, so that they do not hide each other.
double offset_of(size_t series, size_t count) {
  return count < 2 ? 0 : 0.3 * (static_cast<double>(series) / static_cast<double>(count - 1) - 0.5);
}

}  // namespace

Drawing drawing_of(const Dots& dots) {
  Drawing drawing{dots.name, data_of(dots), ""};
  double least = 1, most = 1;
  for (const Dots::Series& series : dots.series)
    for (const auto& dot : series.dots)
      if (dot) least = std::min(least, dot->low), most = std::max(most, dot->high);
  std::string out = fmt::format("# {}\n# Draw again: gnuplot {}.gp\nreset\nload \"style.gp\"\n", dots.title, dots.name);
  out += fmt::format("set title {}\nset xlabel {}\n", single_quoted(dots.title), single_quoted(dots.label));
  out += fmt::format("set logscale x 10\nset format x \"%g\"\nset xrange [{:.6g}:{:.6g}]\nset xtics (", least / 1.3,
                     most * 1.3);
  std::string ticks;
  for (double ten = 0.001; ten < 1.3 * most; ten *= 10)
    for (const double tick : {ten, 2 * ten, 5 * ten})
      if (tick > least / 1.3 && tick < most * 1.3) ticks += fmt::format("{}{:.6g}", ticks.empty() ? "" : ", ", tick);
  out += fmt::format("{})\nset yrange [{:.1f}:0.4]\nset ytics noenhanced (", ticks,
                     static_cast<double>(dots.names.size()) + 0.6);
  for (size_t i = 0; i < dots.names.size(); ++i)
    out += fmt::format("{}{} {}", i ? ", " : "", single_quoted(dots.names[i]), i + 1);
  out += ")\nset arrow from 1, graph 0 to 1, graph 1 nohead lc rgb \"#333333\" lw 1.5 back\n";
  for (const size_t group : dots.groups)
    out += fmt::format(
        "set arrow from graph 0, first {0:.1f} to graph 1, first {0:.1f} nohead lc rgb \"#AAAAAA\" lw 1 back\n",
        static_cast<double>(group) + 0.5);
  std::string plot;
  for (size_t i = 0; i < dots.series.size(); ++i) {
    const Dots::Series& series = dots.series[i];
    if (std::none_of(series.dots.begin(), series.dots.end(), [](const auto& dot) { return dot.has_value(); })) continue;
    plot += fmt::format(
        "{}{} using (strcol(1) eq {} ? $4 : NaN):($3 + {:.3g}):5:6 with xerrorbars lc rgb \"{}\" pt {} ps 1 lw 2 title "
        "{}",
        plot.empty() ? "plot " : ", \\\n     ", single_quoted(dots.name + ".csv"), single_quoted(series.title),
        offset_of(i, dots.series.size()), series.style.colour, series.style.marker, single_quoted(series.title));
  }
  drawing.script = out + terminals(dots.name, 0.3 + 0.05 * static_cast<double>(dots.names.size()), plot + "\n");
  return drawing;
}

}  // namespace crosscheck
