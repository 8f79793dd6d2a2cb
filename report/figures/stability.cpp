// Critical time steps, the moment of failure, and growth that is too slow to be seen in a run.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/stability/limit.h"
#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/figures/step_limits.h"
#include "report/findings/answers.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// The outcome of a run in a word; empty without a run.
std::string outcome_text(const std::string& verdict) {
  if (verdict.empty()) return "";
  return verdict == "ok" ? "stable" : failure_class(verdict);
}

/// Half of the bracket in which the search ended, in parts of the limit.
double half_bracket(const Table& table, size_t row) {
  const auto held = number_at(table, row, "held"), failed = number_at(table, row, "failed");
  return held && failed ? (*failed / *held - 1) / 2 : 0;
}

/// Rows that say the same of several methods as one.
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

/// The critical time steps on one scene as a table for readers.
PageTable limits_table(const Table& table, const std::string& scene) {
  PageTable page{fmt::format("Critical time step on {}.", scene),
                 {"method", "predicted", "measured", "difference", "5 % above", "reason of the difference"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene) continue;
    const std::string &theory = text_at(table, i, "prediction"), &found = text_at(table, i, "measurement");
    if (found == "unsupported") {
      page.rows.push_back({text_at(table, i, "method"), "", "cannot", "", "", text_at(table, i, "reason")});
      continue;
    }
    const auto predicted = number_at(table, i, "predicted limit"), measured = number_at(table, i, "measured limit"),
               off = number_at(table, i, "deviation");
    page.rows.push_back({text_at(table, i, "method"),
                         theory == "limit"  ? step_text(*predicted)
                         : theory == "none" ? "no theory"
                                            : theory,
                         measured                          ? step_text(*measured)
                         : found == "held up to a refusal" ? "at least " + step_text(number_at(table, i, "held", 0))
                                                           : found,
                         off ? deviation_text(*off, half_bracket(table, i)) : "",
                         outcome_text(text_or_none(table, i, "verdict above")), text_or_none(table, i, "reason")});
  }
  join_equal_rows(page);
  return page;
}

/// Says how long the runs were, and how fine the search was.
std::string effort_text(const Table& table) {
  double shortest = INFINITY, longest = 0, finest = INFINITY, coarsest = 0;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "measurement") == "unsupported") continue;
    const double steps = run_of_perturbed(1, static_cast<long>(*number_at(table, i, "steps"))).duration;
    shortest = std::min(shortest, steps), longest = std::max(longest, steps);
    const auto held = number_at(table, i, "held"), failed = number_at(table, i, "failed");
    if (!held || !failed) continue;
    finest = std::min(finest, *failed / *held - 1), coarsest = std::max(coarsest, *failed / *held - 1);
  }
  std::string text;
  if (longest > 0)
    text = fmt::format(" Runs took {} steps.", range(fmt::format("{:.0f}", shortest), fmt::format("{:.0f}", longest)));
  if (coarsest > 0)
    text += fmt::format(" Limits are known to {} %.",
                        range(fmt::format("{:.2g}", 100 * finest), fmt::format("{:.2g}", 100 * coarsest)));
  return text;
}

/// The limits in h omega, with the words that go with them.
StepLimits limits_figure(const Table& table, const std::string& scene, const std::string& commit) {
  StepLimits f = step_limits_of(rows_of<LimitRow>(table), scene);
  TableSet rows;
  rows.add(table);
  f.finding = sentences_of(limit_findings(rows));
  f.caption = fmt::format(
      "Times are on {}, in ms. Divided by the fastest vibration ω of its scene, a rule's limit is one number."
      "{} Commit {}.",
      f.columns_of, effort_text(table), commit);
  f.tier = "exact for small motion under the discrete rule (its stability function at the scene's eigenvalues)";
  return f;
}

/// The limits of all scenes as a figure, or as a table for each scene where theory knows none in h omega. Empty where
/// the table has no rows.
std::vector<Chart> limit_charts(const Table& stability, const std::string& scene, const std::string& commit) {
  if (stability.rows.empty()) return {};
  StepLimits f = limits_figure(stability, scene, commit);
  Chart chart{
      "", std::monostate{}, "stability",
      "Theory takes the scene's Jacobian, its eigenvalues, and for each of them the step at which the method "
      "begins to grow; the least of these steps is the limit. The measurement runs the method, from rest and "
      "kicked by some hundred-millionths of the shortest spring, or from the start where the scene has no rest, "
      "and halves the way between a step that holds and one that fails. It shares with theory the shape of the "
      "vibration that binds: that one is kicked most, and where the rule multiplies it by one factor in every "
      "step its growth is judged, beside that of all motion. Where growth begins by theory it is not told." +
          effort_text(stability),
      f.title};
  if (!f.rows.empty())
    chart.figure = std::move(f);
  else  // a method without theory has a limit all the same
    for (const std::string& each : distinct(stability, "scene")) chart.tables.push_back(limits_table(stability, each));
  return {std::move(chart)};
}

constexpr auto chapter = "stability";

/// "+1.25e-5": four digits, so that what agrees to five reads the same.
std::string signed_text(double value) {
  std::string text = fmt::format("{:+.4g}", value);
  if (const size_t e = text.find("e-0"); e != std::string::npos) text.erase(e + 2, 1);
  return text;
}

/// Growth where no step is stable; that beside limits stands in the table's file.
PageTable growth_table(const Table& table) {
  PageTable page{"Growth of the fastest vibration per time step, where no time step is stable.",
                 {"scene", "method", "h ω", "predicted", "measured"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (!number_at(table, i, "share of limit"))
      page.rows.push_back({text_at(table, i, "scene"), text_at(table, i, "method"),
                           nice(*number_at(table, i, "h omega")), signed_text(*number_at(table, i, "predicted growth")),
                           signed_text(*number_at(table, i, "measured growth"))});
  }
  join_equal_rows(page);
  return page;
}

/// The rows of the two rules that are unstable at every step; they gain too little in a step for runs to show it.
Table slow_blow_ups(const Table& growth) {
  Table slow{growth.name, growth.columns, {}};
  for (size_t i = 0; i < growth.rows.size(); ++i)
    if (const Method* method = builtin_method(text_at(growth, i, "method"));
        method && method->stepper && method->stepper->limit(1, 0) == 0)
      slow.add(growth.rows[i]);
  return slow;
}

std::optional<Chart> growth_chart(const Table& all) {
  const Table growth = slow_blow_ups(all);
  if (growth.rows.empty()) return std::nullopt;
  double off = -1;
  std::string which;
  for (size_t i = 0; i < growth.rows.size(); ++i)
    if (const double deviation = std::abs(number_at(growth, i, "deviation", NAN)); deviation > off) {
      off = deviation;
      which = fmt::format("{} on {}", text_at(growth, i, "method"), text_at(growth, i, "scene"));
    }
  Chart chart{"", std::monostate{}, chapter,
              "Explicit Euler and the explicit trapezoidal rule have no stable step without drag. At short steps they "
              "gain so little in each that a run may look fine: the growth of one vibration is measured instead.",
              "Slowly growing instabilities"};
  if (off >= 0) chart.text += fmt::format(" It differs from theory by at most {} ({}).", percent(off, 1), which);
  if (const size_t others = all.rows.size() - growth.rows.size(); others > 0)
    chart.text += fmt::format(" {} rows of other rules stand in the table {} alone.", others, all.name);
  if (PageTable page = growth_table(growth); !page.rows.empty()) chart.tables.push_back(std::move(page));
  return chart;
}

/// "3 mJ", "1.5 kJ"
std::string energy_text(double energy) {
  const auto [factor, unit] = energy < 0.1    ? std::pair{1e3, "mJ"}
                              : energy < 1000 ? std::pair{1., "J"}
                                              : std::pair{1e-3, "kJ"};
  // two digits, without an exponent
  const double value = factor * energy;
  return value < 100 ? fmt::format("{:.2g} {}", value, unit)
                     : fmt::format("{:.0f} {}", 10 * std::round(value / 10), unit);
}

/// A run above its limit on the scene, or the first scene that has one: its last steps as a curve and in pictures.
std::optional<Chart> failure_chart(const ChartInput& input, const std::string& preferred) {
  std::vector<FailureRow> rows = rows_of<FailureRow>(input.result);
  // of the scenes that fail slowly enough to be seen
  std::set<std::string> seen;
  for (const FailureRow& row : rows)
    if (row.still) seen.insert(row.scene);
  if (seen.empty()) return std::nullopt;
  const std::string name = seen.contains(preferred) ? preferred : *seen.begin();
  std::erase_if(rows, [&](const FailureRow& row) { return row.scene != name; });
  const auto scene = std::ranges::find(input.scenes, name, &Scene::name);
  if (scene == input.scenes.end()) return std::nullopt;
  const FailureRow& first = rows.front();
  const std::string rule = first.method.substr(first.method.find('/') + 1);
  Figure f;
  f.name = "stability-failure";
  f.title = fmt::format("One step too large: {} on {} at {}, {} times its limit", rule, name, step_text(first.h),
                        nice(first.h / first.limit));
  f.x = {"step", false, std::nullopt, std::nullopt};
  f.y = {"kinetic energy / J", true, std::nullopt, std::nullopt};
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
    f.finding = fmt::format("By theory for small motion, energy grows {} times in a step", times_text(*first.growth));
  if (most > 0)
    f.finding += fmt::format("{} {} to {} times here at the end", f.finding.empty() ? "Energy grows" : ";",
                             times_text(least), times_text(most));
  f.finding += f.finding.empty() ? "It fails." : ".";
  f.caption = fmt::format("Beside it the same run at a quarter of the step. Scene {}; commit {}.", name, input.commit);
  f.tier = "measured";
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
  Chart chart{"", std::move(f), chapter};
  chart.snapshots.push_back(std::move(s));
  chart.shown = true;
  return chart;
}

}  // namespace

std::vector<Chart> stability_charts(const ChartInput& input) {
  const Table* table = input.result.table("stability");
  if (!table) return {};
  const Scene* main = main_scene(input.scenes, input.result);
  std::vector<Chart> charts = limit_charts(*table, main ? main->name : "", input.commit);
  if (auto failure = failure_chart(input, main ? main->name : "")) charts.push_back(std::move(*failure));
  const Table *cells = input.result.table("stability-map"), *limits = input.result.table("stability-map-limit");
  if (cells && limits)
    for (Chart& chart : map_charts(*cells, *limits, input.commit)) charts.push_back(std::move(chart));
  if (const Table* growth = input.result.table("stability-growth"))
    if (auto chart = growth_chart(*growth)) charts.push_back(std::move(*chart));
  return charts;
}

}  // namespace crosscheck
