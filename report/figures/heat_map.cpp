// Panels are drawn as boxes, which stay sharp at every size; browsers would smooth an image.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

#include "report/base/gnuplot.h"
#include "report/figures/plot_layout.h"

namespace crosscheck {
namespace {

int columns_of(const HeatMap& map) { return map.size.units() < 600 ? 2 : 3; }

/// Half the smallest distance between neighbours on a logarithmic scale, returned as a factor.
double half_spacing(const std::set<double>& values) {
  double least = 1e300;
  for (auto it = values.begin(); it != values.end() && std::next(it) != values.end(); ++it)
    least = std::min(least, *std::next(it) / *it);
  return least < 1e300 ? std::sqrt(least) : 1.1;
}

struct MapGrid {
  double x_half, y_half;            // factors
  double left, right, bottom, top;  // edges of the cells
};

/// Cells of a panel. Panels share axes, but their cells may differ in size.
MapGrid grid_of(const HeatMap& map, const HeatMap::Panel& panel) {
  std::set<double> xs, ys;
  for (const HeatMap::HeatCell& c : panel.cells) {
    if (!(c.x > 0 && c.y > 0 && std::isfinite(c.x) && std::isfinite(c.y)))
      throw std::runtime_error(fmt::format("figure {}: a value is not above zero", map.name));
    // ignore rounding differences
    xs.insert(std::exp(std::round(std::log(c.x) * 1e6) / 1e6));
    ys.insert(std::exp(std::round(std::log(c.y) * 1e6) / 1e6));
  }
  if (xs.empty()) throw std::runtime_error(fmt::format("figure {}: nothing to draw", map.name));
  const double x_half = half_spacing(xs), y_half = half_spacing(ys);
  return {x_half, y_half, *xs.begin() / x_half, *xs.rbegin() * x_half, *ys.begin() / y_half, *ys.rbegin() * y_half};
}

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
    for (const char* style : {"lc rgb \"#FFFFFF\" lw 5 dt 1", "lc rgb \"#000000\" lw 2 dt (6,4)"})
      parts.push_back(fmt::format("{} with lines {} notitle", rows_of(map, p.title, "predicted limit"), style));
  if (!p.measured.empty())
    for (const char* style : {"lc rgb \"#FFFFFF\" pt 7 ps 0.9", "lc rgb \"#000000\" pt 7 ps 0.6"})
      parts.push_back(fmt::format("{} with points {} notitle", rows_of(map, p.title, "measured limit"), style));
  return joined_plot(parts);
}

std::vector<KeyEntry> key_of(const HeatMap& map) {
  std::vector<KeyEntry> key;
  const auto any = [&](auto has) { return std::ranges::any_of(map.panels, has); };
  for (size_t k = 0; k < map.kinds.size(); ++k)
    if (any([&](const HeatMap::Panel& p) {
          return std::ranges::any_of(p.cells, [&](const auto& c) { return c.kind == static_cast<int>(k); });
        }))
      key.push_back({map.kinds[k].title, KeyEntry::Kind::box, {map.kinds[k].colour, "1", -1}});
  if (any([](const HeatMap::Panel& p) { return !p.predicted.empty(); }))
    key.push_back({"predicted limit", KeyEntry::Kind::line, {"#000000", "(6,4)", -1}});
  if (any([](const HeatMap::Panel& p) { return !p.measured.empty(); }))
    key.push_back({"measured limit", KeyEntry::Kind::mark, {"#000000", "1", 7}});
  return key;
}

}  // namespace

Drawing drawing_of(const HeatMap& map) {
  const MapGrid grid = axes_of(map);
  const int panels = static_cast<int>(map.panels.size()), across = std::min(columns_of(map), panels),
            down = (panels + across - 1) / across;
  const std::vector<KeyEntry> key = key_of(map);
  const double wide = map.size.units(), heading = map.size.titled ? 22 : 4, gap = 12;
  // the height follows from the width, which depends on the widest tick label
  const std::vector<Tick> y_ticks = ticks_of(grid.bottom, grid.top, true, 0.72 * wide / (across + 0.4), true);
  double widest = 0;
  for (const Tick& t : y_ticks) widest = std::max(widest, width_of(t.text));
  const double left = widest + 30, panel = (wide - left - 10 + gap) / across - gap, height = 0.72 * panel,
               row = height + 20, below = 37 + key_height(key, wide - 16) + 4, tall = heading + down * row + below;
  const std::vector<Tick> x_ticks = ticks_of(grid.left, grid.right, true, panel, false);
  std::vector<Tick> x_bare = x_ticks, y_bare = y_ticks;
  for (Tick& t : x_bare) t.text.clear();
  for (Tick& t : y_bare) t.text.clear();
  const Sheet sheet(wide, tall);

  std::string block = "set multiplot\n";
  block += fmt::format("set logscale xy 10\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", grid.left,
                       grid.right, grid.bottom, grid.top);
  block += "unset key\nunset grid\nset border 15 front\n";
  std::vector<std::string> titles;
  for (const auto& panel_of : map.panels) titles.push_back(panel_of.title);
  for (int i = 0; i < panels; ++i) {
    const int r = i / across, c = i % across;
    const double x = left + c * (panel + gap), top = tall - heading - r * row - 17;
    block += sheet.margins({x, x + panel, top - height, top});
    block +=
        "unset label\n" + sheet.text({x + panel / 2, top + 9},
                                     shortened(reader_name(titles[static_cast<size_t>(i)], titles), panel + gap - 4),
                                     "center", "#111111");
    block += tick_command("x", i + across >= panels ? x_ticks : x_bare) + tick_command("y", c == 0 ? y_ticks : y_bare);
    block += panel_plot(map, map.panels[static_cast<size_t>(i)]);
  }
  block += "unset label\nunset logscale\nunset border\nunset tics\n" + sheet.margins({1, 2, 1, 2});
  block += title_command(sheet, map, {wide / 2, tall - 11});
  block += sheet.text({9, below + down * row / 2}, shortened(map.y_label, tall - 8), "center rotate by 90", "#111111");
  block += sheet.text({(left + wide) / 2, below - 28}, shortened(map.x_label, wide - 8), "center", "#111111");
  block += key_commands(sheet, key, {8, below - 37}, wide - 16);
  block += "plot [0:1][0:1] -1 notitle\nunset multiplot\n";
  const std::string script = fmt::format("# {}\n# Draw again: gnuplot {}.gp\n", one_line(map.title), map.name) +
                             terminals_of_block(map, tall, block);
  return {map.name, data_of(map), script};
}

}  // namespace crosscheck
