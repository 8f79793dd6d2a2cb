// Where methods break: largest stable steps, the moment of failure, and growth too slow to be seen.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/stability/limit.h"
#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// The word for what became of a run; empty where there was none.
std::string fate_text(const std::string& verdict) {
  if (verdict.empty()) return "";
  return verdict == "ok" ? "holds" : failure_class_or_cannot(verdict);
}

/// How finely the search ended, in parts of the limit: half of what lies between what held and what failed.
double half_bracket(const Table& table, size_t row) {
  const auto held = number_at(table, row, "held"), failed = number_at(table, row, "failed");
  return held && failed ? (*failed / *held - 1) / 2 : 0;
}

/// Rows of one scene as people read them.
PageTable limits_table(const Table& table, const std::string& scene) {
  PageTable page{fmt::format("The largest stable step on {}.", scene),
                 {"method", "by theory", "as measured", "apart", "a twentieth above", "why apart"},
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
                         fate_text(text_or_none(table, i, "verdict above")), text_or_none(table, i, "reason")});
  }
  return page;
}

/// How long the runs were, and how finely they found what they looked for.
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
    text += fmt::format(" In the end what failed was longer than what held by {} %.",
                        range(fmt::format("{:.2g}", 100 * finest), fmt::format("{:.2g}", 100 * coarsest)));
  return text;
}

constexpr double lowest_drawn = 0.05;  // %

/// Size of the deviation of every method on every scene that theory has a limit for; no curves where there is none.
Figure deviations(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "stability-limits";
  f.title = "Largest stable step: measurement beside theory";
  f.x = {"", false, std::nullopt, std::nullopt};
  f.y = {"difference from theory / %", true, std::nullopt, std::nullopt};
  std::map<std::string, int> scene_at;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto off = number_at(table, i, "deviation");
    if (!off) continue;
    const std::string &scene = text_at(table, i, "scene"), &method = text_at(table, i, "method");
    if (scene_at.try_emplace(scene, static_cast<int>(scene_at.size())).second)
      f.categories.emplace_back(scene_at[scene], scene);
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == method; });
    if (curve == f.curves.end()) {
      f.curves.push_back({method, style_of(method), {}, false, true});
      curve = f.curves.end() - 1;
    }
    curve->points.emplace_back(scene_at[scene],
                               100 * std::max({lowest_drawn / 100, half_bracket(table, i), std::abs(*off)}));
  }
  // side by side, so that no marker hides another
  for (size_t c = 0; c < f.curves.size(); ++c)
    for (auto& point : f.curves[c].points)
      point.first += 0.6 * ((static_cast<double>(c) + 0.5) / static_cast<double>(f.curves.size()) - 0.5);
  f.x.low = -0.5, f.x.high = static_cast<double>(f.categories.size()) - 0.5;
  f.floor = {"1 %", 1};
  for (const StepLimitSummary& summary : step_limit_summaries(table))
    f.finding += (f.finding.empty() ? "" : " ") + summary.sentence;
  f.caption = fmt::format(
      "Differences below {} %, or below what the search could tell, are drawn there; rows in which only one of the two "
      "is a step stand in the tables. Theory "
      "looks at small motion about rest, or about the start where a scene has no rest; commit {}.",
      lowest_drawn, commit);
  f.tier =
      "exact for small motion under the discrete rule (its stability function at the scene's eigenvalues); measured "
      "limits are as fine as their search";
  return f;
}

/// The limits of all scenes: size of the deviation from theory as a figure, where there is one, and a table for each
/// scene. Empty where the table has no rows.
std::vector<Chart> limit_charts(const Table& stability, const std::string& commit) {
  if (stability.rows.empty()) return {};
  Figure f = deviations(stability, commit);
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
  for (const std::string& scene : distinct(stability, "scene")) chart.tables.push_back(limits_table(stability, scene));
  // a method without theory has a limit all the same: it stands in the tables
  if (!f.curves.empty()) chart.figure = std::move(f);
  return {std::move(chart)};
}

constexpr auto chapter = "stability";

/// "+1.25e-5": four digits, so that what agrees to five reads the same.
std::string signed_text(double value) {
  std::string text = fmt::format("{:+.4g}", value);
  if (const size_t e = text.find("e-0"); e != std::string::npos) text.erase(e + 2, 1);
  return text;
}

/// Growth where no step is stable, or close to a limit.
PageTable growth_table(const Table& table, bool without_limit) {
  PageTable page{without_limit ? "Growth of the fastest vibration in each step, where no step is stable."
                               : "Growth (+) or decay (-) of the binding vibration in each step, beside the limit.",
                 {"scene", "method", without_limit ? "h ω" : "step over limit", "by theory", "as measured"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto share = number_at(table, i, "share of limit");
    if (share.has_value() != without_limit)
      page.rows.push_back({text_at(table, i, "scene"), text_at(table, i, "method"),
                           nice(without_limit ? *number_at(table, i, "h omega") : *share),
                           signed_text(*number_at(table, i, "predicted growth")),
                           signed_text(*number_at(table, i, "measured growth"))});
  }
  return page;
}

/// Two rules gain so little in a step that runs do not show it: only their rows are shown, and how many others there
/// are is said.
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
              "Slow blow-ups"};
  if (off >= 0) chart.text += fmt::format(" It differs from theory by at most {} ({}).", percent(off, 1), which);
  if (const size_t others = all.rows.size() - growth.rows.size(); others > 0)
    chart.text +=
        fmt::format(" {} rows of other rules, beside their limits, stand in the table {} alone.", others, all.name);
  for (const bool without_limit : {true, false})
    if (PageTable page = growth_table(growth, without_limit); !page.rows.empty())
      chart.tables.push_back(std::move(page));
  return chart;
}

/// Cloth by symplectic Euler, a twentieth below its limit and a twentieth above.
std::optional<Chart> moment_of_failure(const ChartInput& input, const Table& table) {
  constexpr auto scene_name = "cloth-hang";
  constexpr double seconds = 0.6;
  const auto scene =
      std::find_if(input.scenes.begin(), input.scenes.end(), [](const Scene& each) { return each.name == scene_name; });
  if (scene == input.scenes.end()) return std::nullopt;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto limit = number_at(table, i, "measured limit");
    if (text_at(table, i, "scene") != scene_name || text_at(table, i, "method") != ours || !limit) continue;
    Snapshot s;
    s.name = "stability-moment";
    s.scene = *scene;
    for (const double part : {0.95, 1.05}) {
      // one step per sample: the run must not shorten it
      const double h = part * *limit;
      const int samples = std::max(1, static_cast<int>(seconds / h));
      s.panels.push_back({ours, {h, h * samples, samples}});
    }
    s.caption = fmt::format(
        "Scene {} from its start by symplectic Euler, at steps a twentieth below the measured limit of {} (left) and a "
        "twentieth above (right): at the moment at which the first of them fails, or after {} s if none does.",
        scene_name, step_text(*limit), seconds);
    s.shot.mode = Mode::stretch;
    s.shot.at_first_failure = true;
    s.shot.width = 1280;
    s.shot.height = 560;
    Chart chart{"", std::monostate{}, chapter, "What a limit means: the same cloth at steps a tenth apart.",
                "Below and above a limit"};
    chart.snapshots.push_back(std::move(s));
    return chart;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Chart> stability_charts(const ChartInput& input) {
  const Table* table = input.result.table("stability");
  if (!table) return {};
  std::vector<Chart> charts = limit_charts(*table, input.commit);
  if (auto moment = moment_of_failure(input, *table)) charts.push_back(std::move(*moment));
  const Table *cells = input.result.table("stability-map"), *limits = input.result.table("stability-map-limit");
  if (cells && limits)
    for (Chart& chart : map_charts(*cells, *limits, input.commit)) charts.push_back(std::move(chart));
  if (const Table* growth = input.result.table("stability-growth"))
    if (auto chart = growth_chart(*growth)) charts.push_back(std::move(*chart));
  return charts;
}

}  // namespace crosscheck
