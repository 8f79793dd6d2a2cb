// Bars as boxes with both ends computed here: gnuplot's own stacking adds up heights of both signs.
#include "report/bars.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crosscheck {
namespace {

Table data_of(const Bars& bars) {
  Table table{
      bars.name, {{"part", "1"}, {"name", "1"}, {"place", "1"}, {"from", "see label"}, {"to", "see label"}}, {}};
  std::vector<double> up(bars.names.size(), 0), down(bars.names.size(), 0);
  for (const Bars::Part& part : bars.parts)
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

Drawing drawing_of(const Bars& bars) {
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
  for (const Bars::Part& part : bars.parts) {
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

}  // namespace crosscheck
