// The effect of each ingredient of a scene, and of a finer grid.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/adequacy.h"
#include "report/figures/charts.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

const MethodStyle scene_styles[] = {{"#0072B2", "1", 7},      {"#D55E00", "(6,3)", 5},
                                    {"#009E73", "(2,2)", 9},  {"#CC79A7", "(10,3,2,3)", 13},
                                    {"#E69F00", "(4,2)", 11}, {"#332288", "(12,3,3,3)", 12}};

/// Curve of a value over the number of particles minus `cells_less`.
Curve curve_over(const std::vector<GridRow>& rows, const std::string& scene, double cells_less,
                 OptionalNumber GridRow::*value, const MethodStyle& style) {
  Curve curve{scene, style, {}, true, true};
  for (const GridRow& row : rows | with(&GridRow::scene, scene))
    if (row.*value && *(row.*value) > 0)
      curve.points.emplace_back(static_cast<double>(row.particles) - cells_less, *(row.*value));
  return curve;
}

template <class Range>
void add_categories(Figure& f, const Range& numbers) {
  for (const double n : std::set<double>(numbers.begin(), numbers.end()))
    f.categories.emplace_back(n, fmt::format("{:g}", n));
}

/// True if the last refinement reduced the curve by more than a tenth.
bool still_falls(const Curve& c) {
  return c.points.size() > 1 && c.points.back().second < 0.9 * c.points[c.points.size() - 2].second;
}

/// True if the sag at rest keeps growing with the logarithm of the number of cells. If instead the sag had an error
/// proportional to 1/cells, then, on four grids of 8 to 24 particles, the growth of the sag per log(cells) would halve
/// from the first pair of grids to the last pair.
bool sag_runs_on(const std::vector<GridRow>& rows, const std::string& scene) {
  std::vector<double> growth;
  const GridRow* before = nullptr;
  for (const GridRow& row : rows | with(&GridRow::scene, scene)) {
    if (!row.sag) continue;
    if (before) growth.push_back((*row.sag - *before->sag) / std::log(row.cells / before->cells) / *row.sag);
    before = &row;
  }
  return growth.size() > 1 && growth.front() > 1e-4 && growth.back() > 0.7 * growth.front();
}

std::string motion_sentence(const std::vector<GridRow>& grids, const TableSet& rows, const std::vector<Curve>& curves) {
  std::vector<std::string> falls, others, unbounded;
  size_t fewest = 4;  // 4, because fewer points give only a hint of the power
  for (const Curve& c : curves) fewest = std::min(fewest, c.points.size());
  for (const Curve& c : curves)
    if (sag_runs_on(grids, c.title))
      unbounded.push_back(c.title);
    else if (const auto power = power_of(rows, c.title, ScalingQuantity::error))
      (power->exponent + 2 * power->deviation < 0 && still_falls(c) ? falls : others)
          .push_back(fmt::format("{} on {} ({} grids)", power_text(*power), c.title, c.points.size()));
  std::string text;
  if (!falls.empty())
    text = fmt::format(
        "At constant stiffness the motion {} that of the finest grid: their difference goes as the number "
        "of cells to the power {}{}.",
        fewest < 4 ? "seems to approach" : "approaches", joined(falls),
        fewest < 4 ? ", although so few grids do not prove it" : "");
  if (!others.empty())
    text += fmt::format("{}No convergence up to the last refinement where the power is {}.", text.empty() ? "" : " ",
                        joined(others));
  if (!unbounded.empty())
    text += fmt::format(
        "{}On {} the sag at rest grows with the logarithm of the number of cells: no grid is close to a limit there.",
        text.empty() ? "" : " ", joined(unbounded));
  return text.empty() ? "Difference of the motion from that of the finest grid." : text;
}

PageTable sags_of(const std::vector<GridRow>& rows) {
  PageTable page{
      "Sag at rest with fixed pins and without wind: height of the highest point above the lowest.", {"particles"}, {}};
  const std::vector<std::string> scenes = distinct(rows, &GridRow::scene);
  page.header.insert(page.header.end(), scenes.begin(), scenes.end());
  std::map<long, std::vector<std::string>> by_grid;
  for (const GridRow& row : rows) {
    std::vector<std::string>& texts = by_grid[row.particles];
    texts.resize(page.header.size());
    texts[0] = std::to_string(row.particles);
    const auto column = std::ranges::find(page.header, row.scene) - page.header.begin();
    texts[static_cast<size_t>(column)] = row.sag ? fmt::format("{:.5f} m", *row.sag) : "no rest";
  }
  for (auto& [n, texts] : by_grid) page.rows.push_back(std::move(texts));
  return page;
}

Chart grids(const std::vector<GridRow>& rows, const TableSet& tables, const std::string& commit) {
  Figure f;
  add_categories(f, rows | std::views::transform(&GridRow::particles));
  std::map<std::string, MethodStyle> style;
  double furthest = 0;
  for (const std::string& scene : distinct(rows, &GridRow::scene)) {
    const MethodStyle& own = scene_styles[style.size() % std::size(scene_styles)];
    style[scene] = own;
    Curve c = curve_over(rows, scene, 0, &GridRow::error, own);
    for (const auto& [n, error] : c.points) furthest = std::max(furthest, error);
    // without the finest run, which is the reference, there are no points
    if (!c.points.empty()) f.curves.push_back(std::move(c));
  }
  f.finding = motion_sentence(rows, tables, f.curves);
  std::vector<std::string> failed;
  for (const GridRow& row : rows) {
    if (row.verdict == Verdict::ok) continue;
    const std::string word = failure_class(row.verdict);
    failed.push_back(fmt::format("{} with {} particles along a side ({})", row.scene, row.particles, word));
    if (furthest > 0)
      f.failures.push_back(
          {row.scene + ": " + word, style.at(row.scene), static_cast<double>(row.particles), 3 * furthest});
  }
  Chart chart = described("adequacy-resolution", std::move(f),
                          "failed"_a = failed.empty() ? "" : fmt::format(" Runs that failed: {}.", joined(failed)),
                          "commit"_a = commit);
  chart.tables.push_back(sags_of(rows));
  return chart;
}

/// Stiffness that keeps sag and deflection constant on other grids; nullopt if no such stiffness was found.
std::optional<Chart> scaling(const std::vector<GridRow>& rows, const TableSet& tables, const std::string& commit) {
  Figure f;
  f.y.low = 0.5;
  add_categories(f, rows | std::views::transform(&GridRow::cells));
  size_t style = 0;
  for (const std::string& scene : distinct(rows, &GridRow::scene)) {
    Curve c = curve_over(rows, scene, 1, &GridRow::stiffness_factor, scene_styles[style++ % std::size(scene_styles)]);
    if (c.points.empty()) continue;
    c.title = fmt::format("{}: all springs, for equal sag", scene);
    const double first = c.points.front().second;
    for (auto& point : c.points) point.second /= first;
    f.curves.push_back(std::move(c));
    if (const auto power = power_of(tables, scene, ScalingQuantity::stiffness_for_sag))
      f.finding += fmt::format("{}: stiffness as cells to the power {}. ", scene, power_text(*power));
  }
  if (const auto bending = rows_of<BendingRow>(tables); !bending.empty()) {
    Curve measured{"bend springs of a clamped sheet, for equal deflection", {"#000000", "1", 7}, {}, false, true},
        derived{"limit of many cells: power 4", {"#777777", "(6,3)", -1}, {}};
    for (const BendingRow& row : bending) {
      measured.points.emplace_back(row.cells, row.stiffness / bending[0].stiffness);
      derived.points.emplace_back(row.cells, std::pow(row.cells / bending[0].cells, 4));
    }
    f.curves.push_back(std::move(derived));
    f.curves.push_back(std::move(measured));
  }
  if (f.curves.empty()) return std::nullopt;
  f.finding += sentences_of(bend_findings(tables));
  if (f.finding.empty()) f.finding = "Too few grids to determine a power.";
  return described("adequacy-scaling", std::move(f), "commit"_a = commit);
}

std::string last_of(const std::string& list) {
  const size_t comma = list.rfind(", ");
  return comma == std::string::npos ? list : list.substr(comma + 2);
}

std::string error_text(const std::optional<double>& error) { return error ? nice_length(*error) : "fails"; }

PageTable least_of(const std::vector<LeastModelRow>& least, const std::set<std::string>& scenes) {
  PageTable page{
      "The least model compared with the full one, also from three initial states that were not used to find it.",
      {"scene", "tolerance", "least model", "error", "error from unseen initial states", "cost / full model",
       "meets tolerance"},
      {}};
  for (const LeastModelRow& row : least) {
    if (!scenes.contains(row.scene)) continue;
    const bool all = row.left_out.empty();
    std::vector<std::string> unseen;
    for (const OptionalNumber& error : {row.unseen_error_1, row.unseen_error_2, row.unseen_error_3})
      unseen.push_back(error_text(error) + (error.value_or(INFINITY) > row.tolerance && !all ? " (beyond)" : ""));
    page.rows.push_back({row.scene, fmt::format("{} ({})", nice_length(row.tolerance), name_of(row.tolerance_is)),
                         all ? "full" : row.least_model, error_text(row.error),
                         fmt::format("{}{}", all ? "any removal: " : "", fmt::join(unseen, ", ")),
                         fmt::format("{:.0f} %", 100 * row.cost_of_full), row.holds ? "yes" : "no"});
  }
  return page;
}

Chart removal_chart(const std::vector<AdequacyRow>& rows, const std::string& scene, const std::string& commit) {
  Figure f;
  f.x.low = -0.6;
  Curve single{"this ingredient removed", {"#0072B2", "1", 7}, {}, false, true},
      cumulative{"removed in addition to those before it", {"#D55E00", "(6,3)", 5}, {}, true, true},
      full{"full model (error of stepper and time step)", {"#666666", "1", 4}, {}, false, true};
  double x = 0;
  AdequacyRow last;
  std::string smallest;
  double of_smallest = INFINITY;
  std::vector<std::string> within, without_result;
  for (const AdequacyRow& row : rows | with(&AdequacyRow::scene, scene)) {
    last = row;
    const std::string& out = row.left_out;
    const bool is_single = row.kind == ModelKind::single;
    f.categories.emplace_back(x, row.kind == ModelKind::full ? "full" : is_single ? out : "… and " + last_of(out));
    if (row.kind == ModelKind::cumulative)
      cumulative.title = fmt::format("removed in addition, after {}", out.substr(0, out.find(", ")));
    Curve& curve = row.kind == ModelKind::full ? full : is_single ? single : cumulative;
    if (row.error && *row.error > 0) {
      curve.points.emplace_back(x, *row.error);
      if (is_single && *row.error < of_smallest) of_smallest = *row.error, smallest = out;
    } else if (!row.error) {
      f.failures.push_back({"no result: " + failure_class(row.verdict),
                            {"#CC3311", "1", 2},
                            x,
                            std::max(3 * row.motion, row.tolerance)});
      without_result.push_back(out);
    }
    if (is_single && row.error && *row.error <= row.tolerance) within.push_back(out);
    x += 1;
  }
  f.x.high = x - 0.4;
  for (Curve* c : {&full, &single, &cumulative})
    if (!c->points.empty()) f.curves.push_back(*c);
  const std::string tolerance = nice_length(last.tolerance);
  f.floor = {"tolerance of the scene", last.tolerance};
  for (const int percent : {10, 1})
    if (last.motion > 0)
      f.guides.push_back({false, percent / 100. * last.motion, fmt::format("{} % of the motion", percent)});
  f.finding = !within.empty() ? fmt::format("Within {}, each of these can be left out on its own: {}.", tolerance,
                                            fmt::join(within, ", "))
              : std::isfinite(of_smallest)
                  ? fmt::format("Nothing can be left out within {}: any removal costs at least {} ({}).", tolerance,
                                nice_length(of_smallest), smallest)
                  : fmt::format("Nothing can be left out within {}: no smaller model gives an answer.", tolerance);
  // a scene at rest has no curves, because no removal causes an error
  const bool any = !f.curves.empty();
  if (!any) f.failures.clear();
  Chart chart = described("{scene}-adequacy", std::move(f), "scene"_a = scene, "commit"_a = commit,
                          "truth"_a = last.truth, "bar"_a = nice_length(last.truth_bar));
  if (!any)
    chart.text = without_result.empty() ? "No removal changes the motion."
                                        : fmt::format("No answer without {}; no other removal changes the motion.",
                                                      fmt::join(without_result, ", "));
  return chart;
}

/// Adds the scene's question to a chart if the scene has no card in the report.
void add_question(Chart& chart, const std::vector<Scene>& shown, const std::string& scene) {
  const auto shipped = shipped_scenes();
  if (std::ranges::none_of(shown, [&](const Scene& s) { return s.name == scene; }) &&
      std::ranges::find(shipped, scene) != shipped.end())
    chart.text = load_scene(scene).question + (chart.text.empty() ? "" : " ") + chart.text;
}

/// Table of the removal with the smallest error, for each scene that has no chart of its own.
PageTable least_removals_of(const std::vector<AdequacyRow>& rows, const std::vector<std::string>& scenes) {
  PageTable page{"The removal with the smallest error", {"scene", "removed", "error", "error / motion"}, {}};
  for (const std::string& scene : scenes) {
    const AdequacyRow* least = nullptr;
    for (const AdequacyRow& row : rows | with(&AdequacyRow::scene, scene))
      if (row.kind == ModelKind::single && row.error && (!least || *row.error < *least->error)) least = &row;
    if (least)
      page.rows.push_back({scene, least->left_out, error_text(least->error),
                           least->motion > 0 ? percent(*least->error, least->motion) : ""});
    else
      page.rows.push_back({scene, "every removal fails", "", ""});
  }
  return page;
}

}  // namespace

std::vector<Chart> adequacy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  std::vector<std::string> others;
  std::set<std::string> shown;
  const auto rows = rows_of<AdequacyRow>(input.result);
  for (const std::string& scene : distinct(rows, &AdequacyRow::scene))
    if (has_own_charts("adequacy", scene, input.all)) {
      charts.push_back(removal_chart(rows, scene, input.commit));
      add_question(charts.back(), input.scenes, scene);
      shown.insert(scene);
    } else
      others.push_back(scene);
  if (PageTable page = least_of(rows_of<LeastModelRow>(input.result), shown); !page.rows.empty())
    charts.push_back({"", std::monostate{}, "adequacy", "", "Least models", {std::move(page)}});
  if (!others.empty())
    charts.push_back({"",
                      std::monostate{},
                      "adequacy",
                      "For figures of these scenes: --full, or a report of them alone.",
                      "Other scenes",
                      {least_removals_of(rows, others)}});
  if (const auto all = rows_of<GridRow>(input.result); !all.empty()) {
    charts.push_back(grids(all, input.result, input.commit));
    if (auto chart = scaling(all, input.result, input.commit)) charts.push_back(std::move(*chart));
  }
  return charts;
}

}  // namespace crosscheck
