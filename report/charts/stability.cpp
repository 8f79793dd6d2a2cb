// Where methods break: limits, the moment of failure, maps, and growth too slow to be seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/charts/stability_parts.h"
#include "report/findings_text.h"
#include "report/limits_told.h"

namespace crosscheck {
namespace {

constexpr auto chapter = "stability";

/// "+1.25e-5": four digits, so that what agrees to five reads the same.
std::string signed_text(double value) {
  std::string text = fmt::format("{:+.4g}", value);
  if (const size_t e = text.find("e-0"); e != std::string::npos) text.erase(e + 2, 1);
  return text;
}

/// Growth where no step is stable, or just beside a limit.
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
    if (const std::string& method = text_at(growth, i, "method");
        method == "mysim/explicit-euler" || method == "mysim/trapezoidal")
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
