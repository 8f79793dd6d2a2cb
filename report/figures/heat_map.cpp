// Panels of boxes by gnuplot: boxes stay sharp at every size, where browsers would smooth an image.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

#include "report/figures/figure.h"

namespace crosscheck {
namespace {

/// Panels side by side.
int columns_of(const HeatMap& map) { return map.size.units() < 600 ? 2 : 3; }

/// Half the distance of two neighbouring values, as a factor.
double half_spacing(const std::set<double>& values) {
  double least = 1e300;
  for (auto it = values.begin(); it != values.end() && std::next(it) != values.end(); ++it)
    least = std::min(least, *std::next(it) / *it);
  return least < 1e300 ? std::sqrt(least) : 1.1;
}

struct MapGrid {
  double x_half, y_half;            // factors
  double left, right, bottom, top;  // ends of the cells
};

/// Of one panel: others may have more cells over the same axes.
MapGrid grid_of(const HeatMap& map, const HeatMap::Panel& panel) {
  std::set<double> xs, ys;
  for (const HeatMap::HeatCell& c : panel.cells) {
    if (!(c.x > 0 && c.y > 0 && std::isfinite(c.x) && std::isfinite(c.y)))
      throw std::runtime_error(fmt::format("figure {}: a value is not above zero", map.name));
    // values that differ by rounding alone are one
    xs.insert(std::exp(std::round(std::log(c.x) * 1e6) / 1e6));
    ys.insert(std::exp(std::round(std::log(c.y) * 1e6) / 1e6));
  }
  if (xs.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", map.name));
  const double x_half = half_spacing(xs), y_half = half_spacing(ys);
  return {x_half, y_half, *xs.begin() / x_half, *xs.rbegin() * x_half, *ys.begin() / y_half, *ys.rbegin() * y_half};
}

/// The axes of all panels.
MapGrid axes_of(const HeatMap& map) {
  if (map.panels.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", map.name));
  MapGrid all = grid_of(map, map.panels[0]);
  for (const HeatMap::Panel& p : map.panels) {
    const MapGrid grid = grid_of(map, p);
    all.left = std::min(all.left, grid.left), all.right = std::max(all.right, grid.right);
    all.bottom = std::min(all.bottom, grid.bottom), all.top = std::max(all.top, grid.top);
  }
  return all;
}

Table data_of(const HeatMap& map) {
  Table table{map.name,
              {{"panel", "1"},
               {"what", "1"},
               {map.x_label, "see name"},
               {map.y_label, "see name"},
               {"left", "see x"},
               {"right", "see x"},
               {"bottom", "see y"},
               {"top", "see y"}},
              {}};
  for (const HeatMap::Panel& p : map.panels) {
    const MapGrid grid = grid_of(map, p);
    for (const HeatMap::HeatCell& c : p.cells)
      table.add({p.title, map.kinds.at(c.kind).title, c.x, c.y, c.x / grid.x_half, c.x * grid.x_half, c.y / grid.y_half,
                 c.y * grid.y_half});
    for (const auto& [name, line] : {std::pair{"predicted limit", &p.predicted}, {"measured limit", &p.measured}})
      for (const auto& [x, y] : *line) table.add({p.title, std::string(name), x, y, x, x, y, y});
  }
  return table;
}

/// The rows of one panel and one kind.
std::string rows_of(const HeatMap& map, const std::string& panel, const std::string& what) {
  return fmt::format("{} using (strcol(1) eq {} && strcol(2) eq {} ? $3 : NaN):4", single_quoted(map.name + ".csv"),
                     single_quoted(panel), single_quoted(what));
}

std::string panel_plot(const HeatMap& map, const HeatMap::Panel& p) {
  std::vector<std::string> parts;
  for (size_t k = 0; k < map.kinds.size(); ++k)
    if (std::any_of(p.cells.begin(), p.cells.end(), [&](const auto& c) { return c.kind == static_cast<int>(k); }))
      parts.push_back(
          fmt::format("{}:5:6:7:8 with boxxyerror fs solid 1 border lc rgb \"#FFFFFF\" lw 0.4 fc rgb \"{}\" notitle",
                      rows_of(map, p.title, map.kinds[k].title), map.kinds[k].colour));
  if (!p.predicted.empty())
    for (const char* look : {"lc rgb \"#FFFFFF\" lw 5 dt 1", "lc rgb \"#000000\" lw 2 dt (6,4)"})
      parts.push_back(fmt::format("{} with lines {} notitle", rows_of(map, p.title, "predicted limit"), look));
  if (!p.measured.empty())
    for (const char* look : {"lc rgb \"#FFFFFF\" pt 7 ps 0.9", "lc rgb \"#000000\" pt 7 ps 0.6"})
      parts.push_back(fmt::format("{} with points {} notitle", rows_of(map, p.title, "measured limit"), look));
  std::string out = "plot ";
  for (size_t i = 0; i < parts.size(); ++i) out += (i ? ", \\\n     " : "") + parts[i];
  return out + "\n";
}

/// Only what occurs is explained.
std::string key_plot(const HeatMap& map) {
  std::string out = "plot [0:1][0:1] -1 notitle";
  for (size_t k = 0; k < map.kinds.size(); ++k)
    if (std::any_of(map.panels.begin(), map.panels.end(), [&](const HeatMap::Panel& p) {
          return std::any_of(p.cells.begin(), p.cells.end(),
                             [&](const auto& c) { return c.kind == static_cast<int>(k); });
        }))
      out += fmt::format(", \\\n     keyentry with boxes fs solid 1 fc rgb \"{}\" title {}", map.kinds[k].colour,
                         single_quoted(map.kinds[k].title));
  const auto any = [&](auto line) {
    return std::any_of(map.panels.begin(), map.panels.end(), [&](const auto& p) { return !(p.*line).empty(); });
  };
  if (any(&HeatMap::Panel::predicted))
    out += ", \\\n     keyentry with lines lc rgb \"#000000\" lw 2 dt (6,4) title 'limit by theory'";
  if (any(&HeatMap::Panel::measured))
    out += ", \\\n     keyentry with points lc rgb \"#000000\" pt 7 ps 0.6 title 'limit as measured'";
  return out + "\n";
}

}  // namespace

std::vector<Tooltip> tooltips_of(const HeatMap& map) {
  std::vector<Tooltip> all;
  for (const HeatMap::Panel& p : map.panels)
    for (size_t k = 0; k < map.kinds.size(); ++k)
      for (const HeatMap::HeatCell& c : p.cells)
        if (c.kind == static_cast<int>(k)) all.push_back(c.tooltips);
  return all;
}

Drawing drawing_of(const HeatMap& map) {
  const MapGrid grid = axes_of(map);
  const int columns = columns_of(map);
  const int panels = static_cast<int>(map.panels.size()), across = std::min(columns, panels),
            down = (panels + columns - 1) / columns;
  // heights of the title, a row of panels, the axis below, and the key, which takes more lines where it is narrow
  const double wide = map.size.units(), title = map.size.titled ? 40 : 16,
               row = (across == 1   ? 340
                      : across == 2 ? 270
                                    : 205) *
                     wide / (columns == 3 ? 680 : 590),
               axis = 46, key = 62 * std::max(1.0, 680 / wide);
  const double tall = title + down * row + axis + key;
  std::string block = map.size.titled ? fmt::format("set multiplot title {} font \"DejaVu Sans:Bold,13\" noenhanced\n",
                                                    single_quoted(map.title))
                                      : "set multiplot\n";
  block += fmt::format("set logscale xy 10\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", grid.left,
                       grid.right, grid.bottom, grid.top);
  block += "unset key\nunset grid\nset border 15 front\n";
  for (int i = 0; i < panels; ++i) {
    const int r = i / columns, c = i % columns;
    const double left = 76 + c * (wide - 76 - 12) / across, right = left + (wide - 76 - 12) / across - 14;
    const double top = tall - title - r * row - 20, bottom = tall - title - (r + 1) * row + 6;
    const bool lowest = i + columns >= panels;
    block += fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
        "set bmargin at screen {:.4f}\n",
        left / wide, right / wide, top / tall, bottom / tall);
    block += fmt::format("set title {} font \"DejaVu Sans,10\" offset 0,-0.8 noenhanced\n",
                         single_quoted(map.panels[i].title));
    block += lowest ? fmt::format("set format x \"10^{{%L}}\"\nset xlabel {}\n", single_quoted(map.x_label))
                    : "set format x \"\"\nunset xlabel\n";
    block += c == 0 ? "set format y \"10^{%L}\"\n" : "set format y \"\"\n";
    // of three rows and more the middle one says it for all: below each other the words would meet
    const bool named = c == 0 && (down < 3 || r == down / 2);
    block += named ? fmt::format("set ylabel {}\n", single_quoted(map.y_label)) : "unset ylabel\n";
    block += panel_plot(map, map.panels[i]);
  }
  block += fmt::format(
      "unset logscale\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset title\n"
      "set lmargin at screen 0.02\nset rmargin at screen 0.98\nset bmargin at screen 0.005\nset tmargin at screen "
      "{:.4f}\nset key center center horizontal Left reverse noenhanced samplen 2 width 1\n",
      key / tall);
  block += key_plot(map) + "unset multiplot\n";

  const std::string script =
      fmt::format("# {}\n# Draw again: gnuplot {}.gp\n", map.title, map.name) + terminals_of_block(map, tall, block);
  return {map.name, data_of(map), script};
}

}  // namespace crosscheck
