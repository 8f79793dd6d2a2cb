// Strips of cloth against the elastica and a clamped beam over the grid; skip-one springs beside the bending term.

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "experiments/tables/fabric.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

constexpr const char* colours[] = {"#0072B2", "#7A3B00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333"};

MethodStyle style_at(size_t place) {
  return {colours[place % std::size(colours)], place < 5 ? "1" : "(6,3)", 4 + static_cast<int>(place)};
}

Curve& curve_of(Figure& f, const std::string& title) {
  for (Curve& curve : f.curves)
    if (curve.title == title) return curve;
  f.curves.push_back({title, style_at(f.curves.size()), {}, true, true});
  return f.curves.back();
}

/// By how much a halving of the cells divides the deviation, as a power of two, from the last two points.
double order_at_end(const Curve& curve) {
  const auto& [coarse, before] = curve.points[curve.points.size() - 2];
  const auto& [fine, after] = curve.points.back();
  return std::log(before / after) / std::log(fine / coarse);
}

/// Of the many loads, whose curves lie together: the lightest, a middle one, the heaviest, and the largest at the tip.
bool is_drawn(const CantileverRow& row) {
  return row.tip_load > 0 ? row.tip_load == 5 : row.gamma == 0.1 || row.gamma == 5 || row.gamma == 50;
}

Chart deviations(const std::vector<CantileverRow>& cantilevers, const std::vector<StripVibrationRow>& vibrations,
                 const std::string& commit) {
  Figure f;
  f.name = "fabric-grid";
  f.title = "A strip of cloth with a bending rigidity, against the elastica and a clamped beam";
  f.x = {"cells along the strip", true, std::nullopt, std::nullopt};
  f.y = {"deviation / %", true, std::nullopt, std::nullopt};
  std::set<std::string> drawn;
  for (const CantileverRow& row : cantilevers) {
    const std::string title = row.tip_load > 0 ? fmt::format("drop, P L² / B = {:g}", row.tip_load)
                                               : fmt::format("drop, w L³ / B = {:g}", row.gamma);
    curve_of(f, title).points.emplace_back(static_cast<double>(row.cells), 100 * std::abs(row.deviation));
    if (is_drawn(row)) drawn.insert(title);
  }
  for (const StripVibrationRow& row : vibrations)
    if (row.mode <= 2) {
      const std::string title = fmt::format("frequency {}", row.mode);
      curve_of(f, title).points.emplace_back(static_cast<double>(row.cells), 100 * std::abs(row.deviation));
      drawn.insert(title);
    }
  double worst = 0, low = INFINITY, high = 0;
  for (const Curve& curve : f.curves) {
    worst = std::max(worst, curve.points.back().second);
    low = std::min(low, order_at_end(curve)), high = std::max(high, order_at_end(curve));
  }
  std::erase_if(f.curves, [&](const Curve& curve) { return !drawn.contains(curve.title); });
  for (size_t i = 0; i < f.curves.size(); ++i) f.curves[i].style = style_at(i);
  f.finding = fmt::format(
      "On the finest grid drops and frequencies are right to {} %, and the deviation falls with the "
      "power {:.2f} to {:.2f} of the cells.",
      nice(worst), low, high);
  f.caption = fmt::format(
      "Strips of 20 cm clamped level, at rest under their weight or a load, or vibrating without "
      "weight; commit {}.",
      commit);
  f.tier = "two-point problem of the elastica, and roots of cos β cosh β = −1";
  return {"", std::move(f), "fabric",
          "A rigidity B in N m means the same on every grid, as a beam's does. A clamp is two columns of pins, half a "
          "cell before and behind the edge."};
}

Chart skip_one(const std::vector<SkipOneRow>& rows, const std::string& commit) {
  Figure f;
  f.name = "fabric-skip-one";
  f.title = "Skip-one springs fitted on one grid, and the bending term, over the grid";
  f.x = {"cells along the strip", true, std::nullopt, std::nullopt};
  f.y = {"drop of the tip over the length / %", false, 0, std::nullopt};
  for (const SkipOneRow& row : rows)
    curve_of(f, row.net).points.emplace_back(static_cast<double>(row.cells), 100 * row.drop);
  f.floor = {"elastica", 100 * rows.front().truth};
  double low = INFINITY, high = 0;
  for (const SkipOneRow& row : rows)
    if (row.skip_one > 0) low = std::min(low, row.drop), high = std::max(high, row.drop);
  f.finding = fmt::format(
      "With the same skip-one springs the strip's tip hangs {} % to {} % of its length below the "
      "clamp, by the grid; the elastica's hangs {} %.",
      nice(100 * low), nice(100 * high), nice(100 * rows.front().truth));
  f.caption = fmt::format(
      "A strip of w L³ / B = 5 at rest under its own weight; skip-one springs are as stiff on every "
      "grid as they must be for the elastica's drop on the grid of 16 cells; commit {}.",
      commit);
  f.tier = "two-point problem of the elastica";
  return {
      "", std::move(f), "fabric",
      "Skip-one springs do not resist the bending of a flat sheet to first order: their energy goes with the fourth "
      "power of the angle, so that what they do depends on the grid and on the bend. They stiffen the sheet in its "
      "plane instead."};
}

}  // namespace

std::vector<Chart> fabric_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const auto cantilevers = rows_of<CantileverRow>(input.result);
  const auto vibrations = rows_of<StripVibrationRow>(input.result);
  if (!cantilevers.empty() && !vibrations.empty()) charts.push_back(deviations(cantilevers, vibrations, input.commit));
  if (const auto rows = rows_of<SkipOneRow>(input.result); !rows.empty())
    charts.push_back(skip_one(rows, input.commit));
  return charts;
}

}  // namespace crosscheck
