// Critical time steps, the moment of failure, and growth that is too slow to be visible in a run.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/stability/limit.h"
#include "experiments/tables/stability.h"
#include "report/figures/chapter_parts.h"
#include "report/figures/step_limits.h"
#include "report/findings/answers.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

void join_equal_rows(PageTable& page) {
  std::vector<std::vector<std::string>> joined_rows;
  for (std::vector<std::string>& row : page.rows) {
    const auto same = std::ranges::find_if(joined_rows, [&](const std::vector<std::string>& other) {
      return std::equal(row.begin() + 1, row.end(), other.begin() + 1);
    });
    if (same == joined_rows.end())
      joined_rows.push_back(std::move(row));
    else
      (*same)[0] += ", " + row[0];
  }
  page.rows = std::move(joined_rows);
}

PageTable limits_table(const std::vector<LimitRow>& rows, const std::string& scene) {
  PageTable page{fmt::format("Critical time step on {}.", scene),
                 {"method", "predicted / ms", "measured / ms", "reason of the difference"},
                 {}};
  for (const LimitRow& row : rows | with(&LimitRow::scene, scene))
    page.rows.push_back({row.method, predicted_text(row), measured_text(row), row.reason});
  join_equal_rows(page);
  return page;
}

std::string effort_text(const std::vector<LimitRow>& rows) {
  double shortest = INFINITY, longest = 0, finest = INFINITY, coarsest = 0;
  for (const LimitRow& row : rows) {
    if (row.measurement == MeasuredLimit::unsupported) continue;
    const double steps = run_of_perturbed(1, row.steps).duration;
    shortest = std::min(shortest, steps), longest = std::max(longest, steps);
    if (!row.held || !row.failed) continue;
    const double bracket = *row.failed / *row.held - 1;
    finest = std::min(finest, bracket), coarsest = std::max(coarsest, bracket);
  }
  std::string text;
  if (longest > 0)
    text = fmt::format(" Runs took {} steps.", range(fmt::format("{:.0f}", shortest), fmt::format("{:.0f}", longest)));
  if (coarsest > 0)
    text += fmt::format(" Limits are known to {} %.",
                        range(fmt::format("{:.2g}", 100 * finest), fmt::format("{:.2g}", 100 * coarsest)));
  return text;
}

/// A figure of all scenes, or one table per scene if theory gives no limits in terms of h omega.
Chart limits_chart(const std::vector<LimitRow>& rows, const std::string& scene, const TableSet& tables,
                   const std::string& commit) {
  StepLimits f = step_limits_of(rows, scene);
  f.finding = sentences_of(limit_findings(tables));
  const bool any = !f.rows.empty();
  const std::string columns_of = f.columns_of;
  Chart chart = described("stability-limits", any ? AnyFigure(std::move(f)) : std::monostate{},
                          "effort"_a = effort_text(rows), "scene"_a = columns_of, "commit"_a = commit);
  if (!any)
    for (const std::string& each : distinct(rows, &LimitRow::scene)) chart.tables.push_back(limits_table(rows, each));
  return chart;
}

/// Signed number such as "+1.25e-5", with four digits, so that values that agree to five digits look equal.
std::string signed_text(double value) {
  std::string text = fmt::format("{:+.4g}", value);
  if (const size_t e = text.find("e-0"); e != std::string::npos) text.erase(e + 2, 1);
  return text;
}

/// Growth with the two rules that are unstable at every step. It is too slow to be visible in runs.
std::optional<Chart> growth_chart(const std::vector<GrowthRow>& rows) {
  PageTable page{"Growth of the fastest vibration per time step, where no time step is stable.",
                 {"scene", "method", "h ω", "predicted", "measured"},
                 {}};
  const GrowthRow* furthest = nullptr;
  size_t others = 0;
  for (const GrowthRow& row : rows) {
    const Method* method = builtin_method(row.method);
    if (!method || !method->stepper || method->stepper->limit(1, 0) != 0) {
      ++others;
      continue;
    }
    if (!furthest || std::abs(row.deviation) > std::abs(furthest->deviation)) furthest = &row;
    if (!row.share_of_limit)
      page.rows.push_back(
          {row.scene, row.method, nice(row.h_omega), signed_text(row.predicted), signed_text(row.measured)});
  }
  if (!furthest) return std::nullopt;
  join_equal_rows(page);
  Chart chart = described("stability-growth", std::monostate{}, "off"_a = percent(std::abs(furthest->deviation), 1),
                          "which"_a = fmt::format("{} on {}", furthest->method, furthest->scene),
                          "others"_a = others == 0 ? ""
                                                   : fmt::format(" {} rows of other rules are in the table {} only.",
                                                                 others, GrowthRow::table));
  if (!page.rows.empty()) chart.tables.push_back(std::move(page));
  return chart;
}

/// "3 mJ", "1.5 kJ"
std::string energy_text(double energy) {
  const auto [factor, unit] = energy < 0.1    ? std::pair{1e3, "mJ"}
                              : energy < 1000 ? std::pair{1., "J"}
                                              : std::pair{1e-3, "kJ"};
  // two digits without an exponent
  const double value = factor * energy;
  return value < 100 ? fmt::format("{:.2g} {}", value, unit)
                     : fmt::format("{:.0f} {}", 10 * std::round(value / 10), unit);
}

/// The last steps of a run above its stability limit, on the preferred scene or the first one with such a run.
std::optional<Chart> failure_chart(const ChartInput& input, const std::string& preferred) {
  std::vector<FailureRow> rows = rows_of<FailureRow>(input.result);
  // consider only scenes that fail slowly enough to be visible
  std::set<std::string> seen;
  for (const FailureRow& row : rows)
    if (row.still) seen.insert(row.scene);
  if (seen.empty()) return std::nullopt;
  const std::string name = seen.contains(preferred) ? preferred : *seen.begin();
  std::erase_if(rows, [&](const FailureRow& row) { return row.scene != name; });
  const auto scene = std::ranges::find(input.scenes, name, &Scene::name);
  if (scene == input.scenes.end()) return std::nullopt;
  const FailureRow& first = rows.front();
  Figure f;
  f.curves = {{first.method, style_of(first.method), {}, true, true},
              {"a quarter step", {"#777777", "(4,4)", no_marker}, {}, true, false}};
  f.on_page.flat = true;
  double least = INFINITY, most = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const FailureRow& row = rows[i];
    const auto at = static_cast<double>(row.step);
    if (row.kinetic > 0) {
      f.curves[0].points.emplace_back(at, row.kinetic);
      f.curves[0].tooltips.push_back(
          {fmt::format("{}, step {}\n{}", step_text(row.t), row.step, energy_text(row.kinetic))});
    }
    if (row.holding && *row.holding > 0) f.curves[1].points.emplace_back(at, *row.holding);
    if (i == 0 || !rows[i - 1].holding || !row.holding || !(row.kinetic > 10 * *row.holding)) continue;
    least = std::min(least, row.kinetic / rows[i - 1].kinetic),
    most = std::max(most, row.kinetic / rows[i - 1].kinetic);
  }
  if (f.curves[0].points.empty()) return std::nullopt;
  if (first.growth)
    f.finding = fmt::format("In theory, for small motion, energy grows {} times per step", times_text(*first.growth));
  if (most > 0)
    f.finding += fmt::format("{} {} to {} times here at the end", f.finding.empty() ? "Energy grows" : ";",
                             times_text(least), times_text(most));
  f.finding += f.finding.empty() ? "It fails." : ".";
  Snapshot s{.name = "stability-failure",
             .caption = fmt::format("{} blowing up by {}", name, name_in_sentence(first.method)),
             .scene = *scene,
             .panels = {},
             .shot = usual_shot(*scene, false)};
  const int last = static_cast<int>(rows.back().step);
  s.panels.push_back({first.method, {first.h, first.h * last, last}});
  s.shot.mode = Mode::shaded, s.shot.width = 240, s.shot.height = 176;
  for (const FailureRow& row : rows)
    if (row.still)
      s.moments.emplace_back(row.t,
                             fmt::format("{}, step {}\n{}", step_text(row.t), row.step, energy_text(row.kinetic)));
  Chart chart = described("stability-failure", std::move(f), "rule"_a = first.method.substr(first.method.find('/') + 1),
                          "scene"_a = name, "step"_a = step_text(first.h), "times"_a = nice(first.h / first.limit),
                          "commit"_a = input.commit);
  chart.snapshots.push_back(std::move(s));
  chart.shown = true;
  return chart;
}

}  // namespace

std::vector<Chart> stability_charts(const ChartInput& input) {
  const auto limits = rows_of<LimitRow>(input.result);
  const Scene* main = main_scene(input.scenes, input.result);
  const std::string scene = main ? main->name : "";
  std::vector<Chart> charts;
  if (!limits.empty()) charts.push_back(limits_chart(limits, scene, input.result, input.commit));
  if (auto failure = failure_chart(input, scene)) charts.push_back(std::move(*failure));
  std::ranges::move(map_charts(rows_of<MapRow>(input.result), rows_of<MapLimitRow>(input.result), input.commit),
                    std::back_inserter(charts));
  if (auto growth = growth_chart(rows_of<GrowthRow>(input.result))) charts.push_back(std::move(*growth));
  return charts;
}

}  // namespace crosscheck
