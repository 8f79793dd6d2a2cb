// What each ingredient of a scene is worth.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "experiments/scenes.h"
#include "report/charts/adequacy_parts.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

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
      unseen.push_back(error_text(number_at(least, i, column)) +
                       (number_at(least, i, column, INFINITY) > *number_at(least, i, "tolerance") &&
                                !text_at(least, i, "left out").empty()
                            ? " (beyond)"
                            : ""));
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
  std::vector<std::string> within, unanswered;
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
                            std::max(3 * *number_at(t, i, "motion"), tolerance)});
      unanswered.push_back(out);
    }
    if (kind == "single" && error && *error <= tolerance) within.push_back(out);
    x += 1;
  }
  f.x.high = x - 0.4;
  for (Curve* c : {&full, &single, &cumulative})
    if (!c->points.empty()) f.curves.push_back(*c);
  f.floor = {"tolerance of the scene", tolerance};
  f.finding =
      !within.empty() ? fmt::format("Within {} each of these can be left out alone: {}.", nice_length(tolerance),
                                    fmt::join(within, ", "))
      : std::isfinite(of_smallest)
          ? fmt::format("Nothing can be left out within {}: the least that any removal costs is {} ({}).",
                        nice_length(tolerance), nice_length(of_smallest), smallest)
          : fmt::format("Nothing can be left out within {}: no smaller model gives an answer.", nice_length(tolerance));
  f.caption = fmt::format("Scene {}; commit {}.", scene, commit);
  f.tier = fmt::format("the truth of the full scene: {}, error bar {}", truth, nice_length(bar));
  Chart chart{"", std::monostate{}, "adequacy"};
  // where nothing moves no removal has an error, and there is nothing to draw
  if (!f.curves.empty())
    chart.figure = std::move(f);
  else if (unanswered.empty())
    chart.text = "No removal changes the motion.";
  else
    chart.text = fmt::format("No answer without {}; no other removal changes the motion.", fmt::join(unanswered, ", "));
  chart.heading = scene;
  if (least) chart.tables.push_back(least_of(*least, scene));
  return chart;
}

/// A scene that has no part of its own in the report says here what it asks.
void told_what(Chart& chart, const std::vector<Scene>& told, const std::string& scene) {
  const auto shipped = shipped_scenes();
  if (std::ranges::none_of(told, [&](const Scene& s) { return s.name == scene; }) &&
      std::ranges::find(shipped, scene) != shipped.end())
    chart.text = load_scene(scene).question + (chart.text.empty() ? "" : " ") + chart.text;
}

/// Scenes without a chart of their own: what each of their ingredients is worth, a line each.
PageTable removals_of(const Table& t, const std::vector<std::string>& scenes) {
  PageTable page{"What leaving out one ingredient costs, in parts of the scene's motion",
                 {"scene", "left out", "error", "in parts of the motion"},
                 {}};
  for (const std::string& scene : scenes)
    for (size_t i = 0; i < t.rows.size(); ++i) {
      if (text_at(t, i, "scene") != scene || text_at(t, i, "kind") != "single") continue;
      const auto error = number_at(t, i, "error");
      const double motion = *number_at(t, i, "motion");
      page.rows.push_back({scene, text_at(t, i, "left out"), error_text(error),
                           !error || !(motion > 0) ? failure_word(text_at(t, i, "verdict"))
                           : *error > 10 * motion  ? "over 1000 %"
                                                   : percent(*error, motion)});
    }
  return page;
}

}  // namespace

std::vector<Chart> adequacy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  std::vector<std::string> others;
  if (const Table* t = input.result.table("adequacy")) {
    for (const std::string& scene : distinct(*t, "scene"))
      if (has_own_charts("adequacy", scene, input.all))
        charts.push_back(ladder(*t, input.result.table("adequacy-least"), scene, input.commit)),
            told_what(charts.back(), input.scenes, scene);
      else
        others.push_back(scene);
    if (!others.empty())
      charts.push_back({"",
                        std::monostate{},
                        "adequacy",
                        "Figures of these: --full, or a report of them alone.",
                        "The other scenes",
                        {removals_of(*t, others)}});
  }
  for (Chart& chart : grid_charts(input.result, input.commit)) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace crosscheck
