// What each ingredient of a scene is worth, and what a finer grid is worth.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/cells.h"
#include "report/charts/charts.h"

namespace crosscheck {
namespace {

std::vector<std::string> scenes_in(const Table& t) {
  std::vector<std::string> scenes;
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (scenes.empty() || scenes.back() != text_at(t, i, "scene")) scenes.push_back(text_at(t, i, "scene"));
  return scenes;
}

std::set<double> values_of(const Table& t, const char* column) {
  std::set<double> values;
  for (size_t i = 0; i < t.rows.size(); ++i) values.insert(*number_at(t, i, column));
  return values;
}

/// The last of "a, b, c".
std::string last_of(const std::string& list) {
  const size_t comma = list.rfind(", ");
  return comma == std::string::npos ? list : list.substr(comma + 2);
}

std::string error_text(const std::optional<double>& error) { return error ? nice_length(*error) : "fails"; }

PageTable least_of(const Table& least, const std::string& scene) {
  PageTable page{"The least model, held again against the full one from three starts that it has not seen.",
                 {"tolerance", "least model", "error", "from unseen starts", "cost", "holds"},
                 {}};
  for (size_t i = 0; i < least.rows.size(); ++i) {
    if (text_at(least, i, "scene") != scene) continue;
    std::vector<std::string> unseen;
    for (const char* column : {"unseen error 1", "unseen error 2", "unseen error 3"})
      unseen.push_back(error_text(number_at(least, i, column)));
    const bool all = text_at(least, i, "left out").empty();
    page.rows.push_back(
        {fmt::format("{} ({})", nice_length(*number_at(least, i, "tolerance")), text_at(least, i, "tolerance is")),
         text_at(least, i, "least model"), error_text(number_at(least, i, "error")),
         (all ? "least error of any removal: " : "") + fmt::format("{}", fmt::join(unseen, ", ")),
         fmt::format("{:.0f} %", 100 * *number_at(least, i, "cost of full")),
         *number_at(least, i, "holds") > 0 ? "yes" : "no"});
  }
  return page;
}

Chart ladder(const Table& t, const Table* least, const std::string& scene, const std::string& commit) {
  Figure f;
  f.name = scene + "-adequacy";
  f.title = scene + ": error of each smaller model";
  f.x = {"", false, -0.6, std::nullopt};
  f.y = {"largest RMS error of the model / m", true, std::nullopt, std::nullopt};
  Curve single{"this one left out", {"#0072B2", "1", 7}, {}, false, true},
      cumulative{"this one too, after those before it", {"#D55E00", "(6,3)", 5}, {}, true, true},
      full{"nothing left out (error of the rule and step)", {"#666666", "1", 4}, {}, false, true};
  double x = 0, tolerance = 0, bar = 0;
  std::string truth, smallest;
  double of_smallest = INFINITY;
  std::vector<std::string> within;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if (text_at(t, i, "scene") != scene) continue;
    const std::string kind = text_at(t, i, "kind"), out = text_at(t, i, "left out");
    const auto error = number_at(t, i, "error");
    tolerance = *number_at(t, i, "tolerance"), bar = *number_at(t, i, "truth bar"), truth = text_at(t, i, "truth");
    f.categories.emplace_back(x, kind == "full" ? "full" : kind == "single" ? out : "… and " + last_of(out));
    if (kind == "cumulative") cumulative.title = fmt::format("this one too, after {}", out.substr(0, out.find(", ")));
    Curve& curve = kind == "full" ? full : kind == "single" ? single : cumulative;
    if (error && *error > 0) {
      curve.points.emplace_back(x, *error);
      if (kind == "single" && *error < of_smallest) of_smallest = *error, smallest = out;
    } else if (!error) {
      f.failures.push_back({"no answer: " + failure_word(text_at(t, i, "verdict")),
                            {"#CC3311", "1", 2},
                            x,
                            3 * *number_at(t, i, "motion")});
    }
    if (kind == "single" && error && *error <= tolerance) within.push_back(out);
    x += 1;
  }
  f.x.high = x - 0.4;
  for (Curve* c : {&full, &single, &cumulative})
    if (!c->points.empty()) f.curves.push_back(*c);
  f.floor = {"tolerance of the scene", tolerance};
  f.finding =
      within.empty()
          ? fmt::format("Nothing can be left out within {}: the least that any removal costs is {} ({}).",
                        nice_length(tolerance),
                        error_text(std::isfinite(of_smallest) ? std::optional(of_smallest) : std::nullopt), smallest)
          : fmt::format("Within {} these can be left out: {}.", nice_length(tolerance), fmt::join(within, ", "));
  f.caption = fmt::format("Scene {}; truth of the full scene: {}, error bar {}; commit {}.", scene, truth,
                          nice_length(bar), commit);
  Chart chart{"", std::monostate{}, "adequacy"};
  // where nothing moves no removal has an error, and there is nothing to draw
  if (f.curves.empty())
    chart.text = "Nothing moves in this scene: no removal changes anything.";
  else
    chart.figure = std::move(f);
  chart.heading = scene;
  if (least) chart.tables.push_back(least_of(*least, scene));
  return chart;
}

constexpr MethodStyle looks[] = {{"#0072B2", "1", 7},      {"#D55E00", "(6,3)", 5},
                                 {"#009E73", "(2,2)", 9},  {"#CC79A7", "(10,3,2,3)", 13},
                                 {"#E69F00", "(4,2)", 11}, {"#332288", "(12,3,3,3)", 12}};

Curve column_of(const Table& t, const std::string& scene, const char* column, const MethodStyle& style) {
  Curve curve{scene, style, {}, true, true};
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (text_at(t, i, "scene") == scene)
      if (const auto y = number_at(t, i, column); y && *y > 0)
        curve.points.emplace_back(*number_at(t, i, "particles along a side"), *y);
  return curve;
}

std::string exponent_text(const Table* scaling, const std::string& scene, const std::string& quantity) {
  for (size_t i = 0; scaling && i < scaling->rows.size(); ++i)
    if (text_at(*scaling, i, "scene") == scene && text_at(*scaling, i, "quantity") == quantity)
      return fmt::format("{:.2f} ± {:.2f}", *number_at(*scaling, i, "exponent"),
                         *number_at(*scaling, i, "standard error"));
  return "not told";
}

Chart grids(const Table& t, const std::string& commit) {
  Figure f;
  f.name = "adequacy-resolution";
  f.title = "The same cloth on other grids";
  f.x = {"particles along the longer side", true, std::nullopt, std::nullopt};
  f.y = {"largest RMS distance from the finest grid / m", true, std::nullopt, std::nullopt};
  PageTable sags{"Sag at rest, pins standing still, without wind: lowest below highest point.", {"particles"}, {}};
  std::map<long, std::vector<std::string>> rows;
  for (const double n : values_of(t, "particles along a side")) f.categories.emplace_back(n, fmt::format("{:g}", n));
  size_t style = 0;
  for (const std::string& scene : scenes_in(t)) {
    f.curves.push_back(column_of(t, scene, "error against the finest", looks[style++ % std::size(looks)]));
    sags.header.push_back(scene);
    for (size_t i = 0; i < t.rows.size(); ++i)
      if (text_at(t, i, "scene") == scene) {
        const auto sag = number_at(t, i, "sag");
        auto& row = rows[static_cast<long>(*number_at(t, i, "particles along a side"))];
        row.push_back(sag ? fmt::format("{:.4f} m", *sag) : "no rest");
      }
  }
  for (auto& [n, cells] : rows) {
    cells.insert(cells.begin(), std::to_string(n));
    sags.rows.push_back(cells);
  }
  f.finding = "With the stiffnesses left as they are the motion nears that of the finest grid.";
  f.caption = fmt::format("Leapfrog, compared at 17 x 17 points of the material; commit {}.", commit);
  return {
      "",
      std::move(f),
      "adequacy",
      "A sheet of total mass M keeps its stiffness against stretching and shearing whatever its grid, as k stays: a "
      "finer line of springs has more of them in series, and there are as many lines more. Where it hangs from single "
      "particles it does not: all its weight then pulls at one particle, about which a finer grid gives more (the "
      "stretch about a point load grows without end as the grid is refined).",
      "",
      {std::move(sags)}};
}

Chart scaling(const Table& t, const Table* bending, const Table* exponents, const std::string& commit) {
  Figure f;
  f.name = "adequacy-scaling";
  f.title = "Stiffness for the same cloth on another grid";
  f.x = {"cells along the longer side", true, std::nullopt, std::nullopt};
  f.y = {"stiffness / stiffness on the coarsest grid", true, 0.5, std::nullopt};
  for (const double n : values_of(t, "cells")) f.categories.emplace_back(n, fmt::format("{:g}", n));
  size_t style = 0;
  std::string finding;
  for (const std::string& scene : scenes_in(t)) {
    Curve c = column_of(t, scene, "stiffness factor for the finest's sag", looks[style++ % std::size(looks)]);
    if (c.points.empty()) continue;
    c.title = fmt::format("{}: all springs, for the same sag", scene);
    const double first = c.points.front().second;
    for (auto& [x, y] : c.points) x -= 1, y /= first;
    f.curves.push_back(std::move(c));
    finding += fmt::format("{}: all stiffnesses as cells to the power {}. ", scene,
                           exponent_text(exponents, scene, "stiffness of all springs for the same sag"));
  }
  if (bending && !bending->rows.empty()) {
    Curve measured{"bend springs of a clamped sheet, for the same droop", {"#000000", "1", 7}, {}, false, true},
        derived{"derived: cells to the power 4", {"#777777", "(6,3)", -1}, {}};
    const double k0 = *number_at(*bending, 0, "stiffness of bend springs"), n0 = *number_at(*bending, 0, "cells");
    for (size_t i = 0; i < bending->rows.size(); ++i) {
      const double n = *number_at(*bending, i, "cells");
      measured.points.emplace_back(n, *number_at(*bending, i, "stiffness of bend springs") / k0);
      derived.points.emplace_back(n, std::pow(n / n0, 4));
    }
    f.curves.push_back(std::move(derived));
    f.curves.push_back(std::move(measured));
    finding += fmt::format("Bend springs of a clamped sheet: to the power {}, derived 4.",
                           exponent_text(exponents, "", "stiffness of bend springs for the same droop"));
  }
  f.finding = finding;
  f.caption = fmt::format("Rest found by dynamic relaxation; exponents with their standard errors; commit {}.", commit);
  return {
      "", std::move(f), "adequacy",
      "Springs over two cells resist bending only by what a bent pair of cells is shorter than a flat one, which "
      "falls as the third power of the cell: for the same sheet they must stiffen as the fourth power of the number "
      "of cells. With one stiffness on all grids a finer sheet folds more freely."};
}

}  // namespace

std::vector<Chart> adequacy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Rows& rows = input.result;
  if (const Table* t = rows.table("adequacy"))
    for (const std::string& scene : scenes_in(*t))
      charts.push_back(ladder(*t, rows.table("adequacy-least"), scene, input.commit));
  if (const Table* t = rows.table("adequacy-resolution"); t && !t->rows.empty()) {
    charts.push_back(grids(*t, input.commit));
    charts.push_back(scaling(*t, rows.table("adequacy-bending"), rows.table("adequacy-scaling"), input.commit));
  }
  // a cloth without a rest has no sag on any grid
  std::erase_if(charts, [](const Chart& c) {
    const auto* f = std::get_if<Figure>(&c.figure);
    return f && f->curves.empty();
  });
  return charts;
}

}  // namespace crosscheck
