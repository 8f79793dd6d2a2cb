// The effect of each ingredient of a scene, and of a finer grid.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

const MethodStyle scene_styles[] = {{"#0072B2", "1", 7},      {"#D55E00", "(6,3)", 5},
                                    {"#009E73", "(2,2)", 9},  {"#CC79A7", "(10,3,2,3)", 13},
                                    {"#E69F00", "(4,2)", 11}, {"#332288", "(12,3,3,3)", 12}};

std::set<double> values_of(const Table& t, const char* column) {
  std::set<double> values;
  for (size_t i = 0; i < t.rows.size(); ++i) values.insert(*number_at(t, i, column));
  return values;
}

Curve column_of(const Table& t, const std::string& scene, const char* column, const MethodStyle& style) {
  Curve curve{scene, style, {}, true, true};
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (text_at(t, i, "scene") == scene)
      if (const auto y = number_at(t, i, column); y && *y > 0)
        curve.points.emplace_back(*number_at(t, i, "particles along a side"), *y);
  return curve;
}

/// Whether the last refinement brought a curve down too, by a tenth at least.
bool still_falls(const Curve& c) {
  return c.points.size() > 1 && c.points.back().second < 0.9 * c.points[c.points.size() - 2].second;
}

/// Whether the sag at rest grows with the logarithm of the number of cells without slowing down. Where it settled like
/// 1 / cells its growth would halve from the first two of four grids from 8 to 24 particles to the last two.
bool sag_runs_on(const Table& t, const std::string& scene) {
  std::vector<double> growth;
  std::optional<std::pair<double, double>> before;  // logarithm of cells, sag
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const auto sag = number_at(t, i, "sag");
    if (text_at(t, i, "scene") != scene || !sag) continue;
    const std::pair now{std::log(*number_at(t, i, "cells")), *sag};
    if (before) growth.push_back((now.second - before->second) / (now.first - before->first) / *sag);
    before = now;
  }
  return growth.size() > 1 && growth.front() > 1e-4 && growth.back() > 0.7 * growth.front();
}

/// How the difference from the finest grid falls with the number of cells, scene by scene.
std::string motion_sentence(const Table& grids, const TableSet& rows, const std::vector<Curve>& curves) {
  std::vector<std::string> falls, others, unbounded;
  size_t fewest = 4;  // fewer points than these only hint at a power
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
        "With the stiffnesses left as they are the motion {} that of the finest grid: its distance goes as the number "
        "of cells to the power {}{}.",
        fewest < 4 ? "seems to near" : "nears", joined(falls), fewest < 4 ? ", which so few grids do not prove" : "");
  if (!others.empty())
    text += fmt::format("{}Up to the last refinement no nearing is seen where the power is {}.",
                        text.empty() ? "" : " ", joined(others));
  if (!unbounded.empty())
    text += fmt::format(
        "{}On {} the sag at rest grows with the logarithm of the number of cells: no grid is near a limit there.",
        text.empty() ? "" : " ", joined(unbounded));
  return text.empty() ? "Distances of the motion from that of the finest grid." : text;
}

PageTable sags_of(const Table& t) {
  PageTable page{
      "Sag at rest with fixed pins and without wind: height of the highest point above the lowest.", {"particles"}, {}};
  const std::vector<std::string> scenes = distinct(t, "scene");
  page.header.insert(page.header.end(), scenes.begin(), scenes.end());
  for (const double n : values_of(t, "particles along a side")) {
    std::vector<std::string> row{fmt::format("{:g}", n)};
    for (const std::string& scene : scenes) {
      row.emplace_back();
      for (size_t i = 0; i < t.rows.size(); ++i)
        if (text_at(t, i, "scene") == scene && number_at(t, i, "particles along a side") == n) {
          const auto sag = number_at(t, i, "sag");
          row.back() = sag ? fmt::format("{:.5f} m", *sag) : "no rest";
        }
    }
    page.rows.push_back(std::move(row));
  }
  return page;
}

Chart grids(const Table& t, const TableSet& rows, const std::string& commit) {
  Figure f;
  f.name = "adequacy-resolution";
  f.title = "Grid refinement at constant spring stiffness";
  f.x = {"particles along the longer side", true, std::nullopt, std::nullopt};
  f.y = {"RMS difference from the finest grid / m", true, std::nullopt, std::nullopt};
  for (const double n : values_of(t, "particles along a side")) f.categories.emplace_back(n, fmt::format("{:g}", n));
  std::map<std::string, MethodStyle> style;
  double furthest = 0;
  for (const std::string& scene : distinct(t, "scene")) {
    const size_t index = style.size() % std::size(scene_styles);
    Curve c = column_of(t, scene, "error against the finest", style.emplace(scene, scene_styles[index]).first->second);
    for (const auto& [n, error] : c.points) furthest = std::max(furthest, error);
    // where the finest run failed there is no reference
    if (!c.points.empty()) f.curves.push_back(std::move(c));
  }
  std::vector<std::string> failed;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const std::string &verdict = text_at(t, i, "verdict"), &scene = text_at(t, i, "scene");
    if (verdict == "ok") continue;
    const double n = *number_at(t, i, "particles along a side");
    failed.push_back(fmt::format("{} with {:g} particles along a side ({})", scene, n, failure_class(verdict)));
    f.failures.push_back({scene + ": " + failure_class(verdict), style.at(scene), n, 3 * furthest});
  }
  f.finding = motion_sentence(t, rows, f.curves);
  f.tier = "the finest grid of each scene, which is itself not converged";
  f.caption = fmt::format("Leapfrog, compared at 17 x 17 points of the material; commit {}.", commit);
  Chart chart{
      "",
      std::monostate{},
      "adequacy",
      "A sheet of total mass M keeps its stiffness against stretching and shearing whatever its grid, as k stays: a "
      "finer line of springs has more of them in series, and there are as many lines more. Where it hangs from single "
      "particles it does not: all its weight then pulls at one particle, about which a finer grid gives more (the "
      "stretch about a point load grows without end as the grid is refined).",
      f.title,
      {sags_of(t)}};
  if (!failed.empty()) chart.text += fmt::format(" Runs that failed: {}.", joined(failed));
  if (!f.curves.empty()) chart.figure = std::move(f);
  return chart;
}

/// The stiffness that keeps sag and deflection on other grids; empty where neither was found.
std::optional<Chart> scaling(const Table& t, const TableSet& rows, const std::string& commit) {
  Figure f;
  f.name = "adequacy-scaling";
  f.title = "Spring stiffness under grid refinement";
  f.x = {"cells along the longer side", true, std::nullopt, std::nullopt};
  f.y = {"stiffness / stiffness on the coarsest grid", true, 0.5, std::nullopt};
  for (const double n : values_of(t, "cells")) f.categories.emplace_back(n, fmt::format("{:g}", n));
  size_t style = 0;
  for (const std::string& scene : distinct(t, "scene")) {
    Curve c =
        column_of(t, scene, "stiffness factor for the finest's sag", scene_styles[style++ % std::size(scene_styles)]);
    if (c.points.empty()) continue;
    c.title = fmt::format("{}: all springs, for equal sag", scene);
    const double first = c.points.front().second;
    for (auto& [x, y] : c.points) x -= 1, y /= first;
    f.curves.push_back(std::move(c));
    if (const auto power = power_of(rows, scene, ScalingQuantity::stiffness_for_sag))
      f.finding += fmt::format("{}: stiffness as cells to the power {}. ", scene, power_text(*power));
  }
  if (const Table* bending = rows.table("adequacy-bending"); bending && !bending->rows.empty()) {
    Curve measured{"bend springs of a clamped sheet, for equal deflection", {"#000000", "1", 7}, {}, false, true},
        derived{"limit of many cells: power 4", {"#777777", "(6,3)", -1}, {}};
    const double k0 = *number_at(*bending, 0, "stiffness of bend springs"), n0 = *number_at(*bending, 0, "cells");
    for (size_t i = 0; i < bending->rows.size(); ++i) {
      const double n = *number_at(*bending, i, "cells");
      measured.points.emplace_back(n, *number_at(*bending, i, "stiffness of bend springs") / k0);
      derived.points.emplace_back(n, std::pow(n / n0, 4));
    }
    f.curves.push_back(std::move(derived));
    f.curves.push_back(std::move(measured));
  }
  if (f.curves.empty()) return std::nullopt;
  f.finding += sentences_of(bend_findings(rows));
  if (f.finding.empty()) f.finding = "Too few grids to tell a power.";
  f.tier = "for bend springs the power that is derived for many cells (dashed)";
  f.caption = fmt::format("Rest found by dynamic relaxation; exponents with their standard errors; commit {}.", commit);
  return Chart{
      "", std::move(f), "adequacy",
      "Springs over two cells resist bending only by what a bent pair of cells is shorter than a flat one, which "
      "falls as the third power of the cell: for the same sheet they must stiffen as the fourth power of the number "
      "of cells, where these are many. With one stiffness on all grids a finer sheet folds more freely."};
}

/// Grid refinement at constant stiffness, and the stiffness that makes up for it.
std::vector<Chart> grid_charts(const TableSet& rows, const std::string& commit) {
  const Table* t = rows.table("adequacy-resolution");
  if (!t || t->rows.empty()) return {};
  std::vector<Chart> charts{grids(*t, rows, commit)};
  if (auto chart = scaling(*t, rows, commit)) charts.push_back(std::move(*chart));
  return charts;
}

/// The last of "a, b, c".
std::string last_of(const std::string& list) {
  const size_t comma = list.rfind(", ");
  return comma == std::string::npos ? list : list.substr(comma + 2);
}

std::string error_text(const std::optional<double>& error) { return error ? nice_length(*error) : "fails"; }

/// The least models of `scenes`.
PageTable least_of(const Table& least, const std::set<std::string>& scenes) {
  PageTable page{"The least model against the full one, also from three initial states that were not used to find it.",
                 {"scene", "tolerance", "least model", "error", "error from unseen initial states", "cost / full model",
                  "meets tolerance"},
                 {}};
  for (size_t i = 0; i < least.rows.size(); ++i) {
    const std::string scene = text_at(least, i, "scene");
    if (!scenes.contains(scene)) continue;
    std::vector<std::string> unseen;
    for (const char* column : {"unseen error 1", "unseen error 2", "unseen error 3"})
      unseen.push_back(error_text(number_at(least, i, column)) +
                       (number_at(least, i, column, INFINITY) > *number_at(least, i, "tolerance") &&
                                !text_at(least, i, "left out").empty()
                            ? " (beyond)"
                            : ""));
    const bool all = text_at(least, i, "left out").empty();
    page.rows.push_back(
        {scene,
         fmt::format("{} ({})", nice_length(*number_at(least, i, "tolerance")), text_at(least, i, "tolerance is")),
         all ? "full" : text_at(least, i, "least model"), error_text(number_at(least, i, "error")),
         (all ? "any removal: " : "") + fmt::format("{}", fmt::join(unseen, ", ")),
         fmt::format("{:.0f} %", 100 * *number_at(least, i, "cost of full")),
         *number_at(least, i, "holds") > 0 ? "yes" : "no"});
  }
  return page;
}

Chart removal_chart(const Table& t, const std::string& scene, const std::string& commit) {
  Figure f;
  f.name = scene + "-adequacy";
  f.title = scene + ": error of each smaller model";
  f.x = {"", false, -0.6, std::nullopt};
  f.y = {"RMS position error of the model / m", true, std::nullopt, std::nullopt};
  Curve single{"this ingredient removed", {"#0072B2", "1", 7}, {}, false, true},
      cumulative{"removed in addition to those before it", {"#D55E00", "(6,3)", 5}, {}, true, true},
      full{"full model (error of stepper and time step)", {"#666666", "1", 4}, {}, false, true};
  double x = 0, tolerance = 0, error_bar = 0, motion = 0;
  std::string truth, smallest;
  double of_smallest = INFINITY;
  std::vector<std::string> within, without_result;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if (text_at(t, i, "scene") != scene) continue;
    const std::string kind = text_at(t, i, "kind"), out = text_at(t, i, "left out");
    const auto error = number_at(t, i, "error");
    motion = number_at(t, i, "motion", 0), tolerance = *number_at(t, i, "tolerance"),
    error_bar = *number_at(t, i, "truth bar"), truth = text_at(t, i, "truth");
    f.categories.emplace_back(x, kind == "full" ? "full" : kind == "single" ? out : "… and " + last_of(out));
    if (kind == "cumulative")
      cumulative.title = fmt::format("removed in addition, after {}", out.substr(0, out.find(", ")));
    Curve& curve = kind == "full" ? full : kind == "single" ? single : cumulative;
    if (error && *error > 0) {
      curve.points.emplace_back(x, *error);
      if (kind == "single" && *error < of_smallest) of_smallest = *error, smallest = out;
    } else if (!error) {
      f.failures.push_back({"no result: " + failure_class(text_at(t, i, "verdict")),
                            {"#CC3311", "1", 2},
                            x,
                            std::max(3 * *number_at(t, i, "motion"), tolerance)});
      without_result.push_back(out);
    }
    if (kind == "single" && error && *error <= tolerance) within.push_back(out);
    x += 1;
  }
  f.x.high = x - 0.4;
  for (Curve* c : {&full, &single, &cumulative})
    if (!c->points.empty()) f.curves.push_back(*c);
  f.floor = {"tolerance of the scene", tolerance};
  for (const int percent : {10, 1})
    if (motion > 0) f.guides.push_back({false, percent / 100. * motion, fmt::format("{} % of the motion", percent)});
  f.finding =
      !within.empty() ? fmt::format("Within {} each of these can be left out alone: {}.", nice_length(tolerance),
                                    fmt::join(within, ", "))
      : std::isfinite(of_smallest)
          ? fmt::format("Nothing can be left out within {}: any removal costs at least {} ({}).",
                        nice_length(tolerance), nice_length(of_smallest), smallest)
          : fmt::format("Nothing can be left out within {}: no smaller model gives an answer.", nice_length(tolerance));
  f.caption = fmt::format("Scene {}; commit {}.", scene, commit);
  f.tier = fmt::format("the full scene's truth: {}, error bar {}", truth, nice_length(error_bar));
  Chart chart{"", std::monostate{}, "adequacy"};
  // in a scene at rest no removal has an error
  if (!f.curves.empty())
    chart.figure = std::move(f);
  else if (without_result.empty())
    chart.text = "No removal changes the motion.";
  else
    chart.text =
        fmt::format("No answer without {}; no other removal changes the motion.", fmt::join(without_result, ", "));
  chart.heading = scene;
  return chart;
}

/// A scene that has no part of its own in the report states its question here.
void add_question(Chart& chart, const std::vector<Scene>& shown, const std::string& scene) {
  const auto shipped = shipped_scenes();
  if (std::ranges::none_of(shown, [&](const Scene& s) { return s.name == scene; }) &&
      std::ranges::find(shipped, scene) != shipped.end())
    chart.text = load_scene(scene).question + (chart.text.empty() ? "" : " ") + chart.text;
}

/// The removal that costs least on each of the scenes that have no chart of their own.
PageTable least_removals_of(const Table& t, const std::vector<std::string>& scenes) {
  PageTable page{"The removal that costs least", {"scene", "removed", "error", "error / motion"}, {}};
  for (const std::string& scene : scenes) {
    std::optional<size_t> least;
    for (size_t i = 0; i < t.rows.size(); ++i) {
      if (text_at(t, i, "scene") != scene || text_at(t, i, "kind") != "single" || !number_at(t, i, "error")) continue;
      if (!least || *number_at(t, i, "error") < *number_at(t, *least, "error")) least = i;
    }
    if (!least) {
      page.rows.push_back({scene, "every removal fails", "", ""});
      continue;
    }
    const double error = *number_at(t, *least, "error"), motion = number_at(t, *least, "motion", 0);
    page.rows.push_back(
        {scene, text_at(t, *least, "left out"), error_text(error), motion > 0 ? percent(error, motion) : ""});
  }
  return page;
}

}  // namespace

std::vector<Chart> adequacy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  std::vector<std::string> others;
  std::set<std::string> shown;
  if (const Table* t = input.result.table("adequacy")) {
    for (const std::string& scene : distinct(*t, "scene"))
      if (has_own_charts("adequacy", scene, input.all)) {
        charts.push_back(removal_chart(*t, scene, input.commit));
        add_question(charts.back(), input.scenes, scene);
        shown.insert(scene);
      } else
        others.push_back(scene);
    if (const Table* least = input.result.table("adequacy-least"))
      if (PageTable page = least_of(*least, shown); !page.rows.empty())
        charts.push_back({"", std::monostate{}, "adequacy", "", "Least models", {std::move(page)}});
    if (!others.empty())
      charts.push_back({"",
                        std::monostate{},
                        "adequacy",
                        "Figures of these: --full, or a report of them alone.",
                        "Other scenes",
                        {least_removals_of(*t, others)}});
  }
  for (Chart& chart : grid_charts(input.result, input.commit)) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace crosscheck
