// Error against cost, once in evaluations and once in CPU time: curves of all methods, the Pareto line, the floor of
// the truth, crosses for failed runs; and with each figure the cheapest methods.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/tables/table.h"
#include "report/figures/charts.h"

namespace crosscheck {
namespace {

bool same_run(const Table& a, size_t i, const Table& b, size_t j) {
  for (const char* column : {"scene", "method", "setting", "asked"})
    if (a.at(i, column) != b.at(j, column)) return false;
  return true;
}

/// The two costs of a chart.
struct Cost {
  bool time;
  std::string suffix() const { return time ? "-cost" : ""; }
  std::string column() const { return time ? "cpu" : "evaluations"; }
  std::string text_of(double value) const {
    return time ? step_text(value) : value < 1e6 ? fmt::format("{:.0f}", value) : nice(value);
  }
};

/// The summary of one scene's rows.
struct SceneRows {
  const Table& runs;
  const Table* cost;  // of CPU times
  std::string scene, truth;
  std::vector<size_t> rows;
  double motion = 0;
  std::optional<double> error_bar;
  bool difference() const { return truth.find("contact rule") != std::string::npos; }
  /// The quantity drawn over the cost.
  const char* column() const {
    return !error_bar     ? "distance to own finest"
           : difference() ? "largest difference from converged contact"
                          : "largest error";
  }
  std::string measure() const {
    return !error_bar     ? "distance from own finest run"
           : difference() ? "difference from the in-house contact rule"
                          : "error";
  }
  std::optional<double> cost_of(size_t row, const Cost& kind) const {
    if (!kind.time) return number_at(runs, row, "evaluations");
    for (size_t i = 0; cost && i < cost->rows.size(); ++i)
      if (same_run(runs, row, *cost, i)) return number_at(*cost, i, "cpu");
    return std::nullopt;
  }
};

/// Whether the time was taken of a part of the run only, and scaled by its evaluations (of Bullet's worlds: steps).
bool is_scaled(const SceneRows& s, size_t row) {
  for (size_t i = 0; s.cost && i < s.cost->rows.size(); ++i)
    if (same_run(s.runs, row, *s.cost, i)) return number_at(*s.cost, i, "part timed", 1) < 1;
  return false;
}

SceneRows rows_of(const ChartInput& input, const Table& runs, const std::string& scene) {
  SceneRows s{runs, input.result.table("speed-accuracy-cost"), scene, "", {}};
  for (size_t i = 0; i < runs.rows.size(); ++i)
    if (text_or_none(runs, i, "scene") == scene) {
      s.rows.push_back(i);
      s.motion = *number_at(runs, i, "motion");
      s.error_bar = number_at(runs, i, "truth bar");
      s.truth = text_or_none(runs, i, "truth");
    }
  return s;
}

/// "mysim/rk4 3": the fourth row of its method in this scene.
std::string run_of(const SceneRows& s, size_t row) {
  size_t place = 0;
  for (const size_t i : s.rows) place += i < row && s.runs.at(i, "method") == s.runs.at(row, "method");
  return fmt::format("{} {}", text_or_none(s.runs, row, "method"), place);
}

/// A run in three lines, for a pointer above it.
Tooltip tooltips(const SceneRows& s, size_t row, const std::string& outcome) {
  std::string cost;
  for (const Cost kind : {Cost{false}, Cost{true}})
    if (const auto value = s.cost_of(row, kind); value && *value > 0)
      cost += fmt::format("{}{} {}", cost.empty() ? "" : ", ", kind.text_of(*value),
                          !kind.time          ? "evaluations"
                          : is_scaled(s, row) ? "of CPU (scaled from a part of the run)"
                                              : "of CPU");
  const std::string setting = text_or_none(s.runs, row, "setting");
  return {
      fmt::format("{}, {}{}\n{}\n{}", text_or_none(s.runs, row, "method"), setting.starts_with("step") ? "step " : "",
                  setting_text(setting, *number_at(s.runs, row, "asked")), outcome, cost),
      run_of(s, row)};
}

constexpr int scaled_ring = 6;  // gnuplot's open circle

int cross_of(const std::string& word) { return word == "blew up" ? 2 : word == "solver gave up" ? 1 : 3; }

Figure figure_of(const SceneRows& s, const Cost& kind, const ChartInput& input) {
  Figure f;
  f.name = s.scene + "-speed-accuracy" + kind.suffix();
  f.from_costs = kind.time;
  f.runs = s.scene + "-speed-accuracy";
  f.title = fmt::format("{}: {} against {}", s.scene, s.measure(), kind.time ? "CPU time" : "force evaluations");
  f.x = {kind.time ? "CPU time of the run / s" : "force evaluations of the run", true, std::nullopt, std::nullopt};
  const double top = 10 * s.motion, highest = 3 * s.motion;
  double lowest = s.error_bar ? std::max(*s.error_bar, 1e-16) : 1, furthest = 0;
  int failed = 0, good = 0, beyond = 0, uncounted = 0;
  // in a look that no method has, and beneath them all, so that a pointer meets the run
  Curve scaled{scaled_times, {"#777777", "1", scaled_ring}, {}, false, true};
  std::set<std::string> methods;
  for (const size_t i : s.rows) {
    const auto cost = s.cost_of(i, kind);
    const std::string method = text_or_none(s.runs, i, "method"), verdict = text_or_none(s.runs, i, "verdict");
    if (!cost || !(*cost > 0)) {
      uncounted += verdict != "unsupported";
      continue;
    }
    methods.insert(method);
    furthest = std::max(furthest, *cost);
    const bool part = kind.time && is_scaled(s, i);
    if (verdict != "ok") {
      if (part) scaled.points.emplace_back(*cost, 4 * s.motion);
      const std::string word = failure_class(verdict);
      f.failures.push_back({method + ": " + word, style_of(method), *cost, 4 * s.motion, word, cross_of(word),
                            tooltips(s, i, fmt::format("{} at {:.3g} s", word, *number_at(s.runs, i, "end")))});
      ++failed;
      continue;
    }
    const auto apart = number_at(s.runs, i, s.column());
    if (!apart || (!s.error_bar && !(*apart > 0))) continue;
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == method; });
    if (curve == f.curves.end()) curve = f.curves.insert(f.curves.end(), {method, style_of(method), {}, true, true});
    // below its error bar the truth says nothing
    const double y = std::min(highest, s.error_bar ? std::max(*apart, *s.error_bar) : *apart);
    beyond += *apart > highest;
    curve->points.emplace_back(*cost, y);
    if (part) scaled.points.emplace_back(*cost, y);
    curve->tooltips.push_back(tooltips(s, i, s.measure() + " " + nice_length(*apart)));
    lowest = std::min(lowest, y);
    ++good;
  }
  f.y = {fmt::format("largest RMS {} / m", s.difference() ? "difference"
                                           : s.error_bar  ? "error"
                                                          : "distance"),
         true, lowest / 3, top};
  if (const Table* pareto = input.result.table("speed-accuracy-pareto" + kind.suffix()))
    for (size_t i = 0; i < pareto->rows.size(); ++i)
      if (text_or_none(*pareto, i, "scene") == s.scene)
        f.pareto.emplace_back(*number_at(*pareto, i, kind.column().c_str()),
                              std::min(highest, *number_at(*pareto, i, "distance")));
  if (!f.pareto.empty()) f.pareto.emplace_back(furthest, f.pareto.back().second);
  if (s.error_bar) f.floor = {s.difference() ? "how far that answer is known" : "error bar of the truth", *s.error_bar};
  f.finding = fmt::format("{} runs of {} methods; {} failed.", good + failed, methods.size(), failed);
  std::string drawn;
  if (beyond > 0)
    drawn = fmt::format("{} above three times the motion ({}), drawn there; ", beyond, nice_length(highest));
  if (!scaled.points.empty()) {
    f.x.label = "CPU time of the run, ringed: scaled from a part of it / s";
    drawn += fmt::format(
        "{} of {} times are not of the whole run: the first part of it was timed, and scaled by the force evaluations "
        "(of Bullet's implicit and position-based worlds by the steps) of the whole, ringed; ",
        scaled.points.size(), good + failed);
    f.curves.insert(f.curves.begin(), std::move(scaled));
  }
  if (uncounted > 0) drawn += fmt::format("{} of unknown cost, not drawn; ", uncounted);
  f.caption = fmt::format("Scene {}; {}{}commit {}.", s.scene,
                          kind.time ? "thread CPU time, medians of runs taken in turns on one pinned core; " +
                                          builds_text({methods.begin(), methods.end()}) + "; "
                                    : "",
                          drawn, input.commit);
  f.tier = s.error_bar ? fmt::format("{}{}, error bar {}", s.difference() ? "" : "the truth: ", s.truth,
                                     nice_length(*s.error_bar))
                       : "each method's own finest run, since no truth is known";
  return f;
}

/// The table "cheapest that meets 10 %, 1 %, 0.1 % of the motion".
std::optional<PageTable> cheapest_of(const SceneRows& s, const Cost& kind, const ChartInput& input) {
  const Table* t = input.result.table("speed-accuracy-cheapest" + kind.suffix());
  if (!t || !s.error_bar) return std::nullopt;
  PageTable page;
  page.caption = fmt::format("The cheapest run of those tried with {} of at most a part of the motion ({}), in {}",
                             s.difference() ? "a difference" : "an error", nice_length(s.motion),
                             kind.time ? "CPU time" : "force evaluations");
  page.header = {"at most",        "cheapest", "step",     "cost",
                 "best of Bullet", "its step", "its cost", "times as much as mysim's"};
  if (kind.time) page.header.emplace_back("as cheap, within noise");
  const std::string column = kind.column();
  for (size_t i = 0; i < t->rows.size(); ++i) {
    if (text_or_none(*t, i, "scene") != s.scene) continue;
    std::vector<std::string> row{
        fmt::format("{:g} % ({})", 100 * *number_at(*t, i, "part of motion"), nice_length(*number_at(*t, i, "bound")))};
    const std::string remark = text_or_none(*t, i, "remark");
    row.push_back(remark.empty() ? text_or_none(*t, i, "method") : remark);
    const auto asked = number_at(*t, i, "asked"), theirs = number_at(*t, i, "asked of Bullet");
    row.push_back(asked ? setting_text(text_or_none(*t, i, "setting"), *asked) : "");
    row.push_back(asked ? kind.text_of(*number_at(*t, i, column.c_str())) : "");
    row.push_back(theirs ? text_or_none(*t, i, "best of Bullet") : "");
    row.push_back(theirs ? setting_text(text_or_none(*t, i, "setting of Bullet"), *theirs) : "");
    row.push_back(theirs ? kind.text_of(*number_at(*t, i, (column + " of Bullet").c_str())) : "");
    const auto factor = number_at(*t, i, "Bullet / mysim");
    row.push_back(factor ? fmt::format("{:.3g}", *factor) : "");
    if (kind.time) row.push_back(text_or_none(*t, i, "as cheap within noise"));
    page.rows.push_back(std::move(row));
  }
  if (page.rows.empty()) return std::nullopt;
  return page;
}

/// Every run: a row for each method, a column for each step or tolerance.
std::optional<PageTable> all_runs(const SceneRows& s, const std::string& setting) {
  std::set<double, std::greater<>> values;
  std::vector<std::string> methods;
  for (const size_t i : s.rows) {
    if (text_or_none(s.runs, i, "setting") != setting) continue;
    values.insert(*number_at(s.runs, i, "asked"));
    if (const std::string m = text_or_none(s.runs, i, "method"); methods.empty() || methods.back() != m)
      methods.push_back(m);
  }
  if (methods.empty()) return std::nullopt;
  PageTable page;
  page.caption = fmt::format("All runs at {}: largest RMS {}, or how the run failed and when",
                             setting.starts_with("tolerance") ? "a tolerance" : "fixed steps", s.measure());
  page.header = {"method"};
  for (const double value : values) page.header.push_back(setting_text(setting, value));
  for (const std::string& method : methods) {
    std::vector<std::string> row(values.size() + 1);
    row[0] = method;
    for (const size_t i : s.rows) {
      if (text_or_none(s.runs, i, "setting") != setting || text_or_none(s.runs, i, "method") != method) continue;
      const std::string verdict = text_or_none(s.runs, i, "verdict");
      const auto apart = number_at(s.runs, i, s.column());
      const auto at = std::distance(values.begin(), values.find(*number_at(s.runs, i, "asked")));
      row[static_cast<size_t>(at) + 1] =
          verdict != "ok" ? fmt::format("{} at {:.3g} s", failure_class(verdict), *number_at(s.runs, i, "end"))
          : !apart        ? "the finest"
          : s.error_bar && *apart < *s.error_bar ? "< " + nice_length(*s.error_bar)
                                                 : nice_length(*apart);
    }
    page.rows.push_back(std::move(row));
  }
  return page;
}

}  // namespace

std::vector<Chart> speed_accuracy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* runs = input.result.table("speed-accuracy");
  for (size_t i = 0; runs && i < input.scenes.size(); ++i) {
    if (!has_own_charts("speed-accuracy", input.scenes[i].name, input.all)) continue;
    const SceneRows s = rows_of(input, *runs, input.scenes[i].name);
    if (s.rows.empty()) continue;
    for (const Cost kind : {Cost{true}, Cost{false}}) {
      Figure f = figure_of(s, kind, input);
      if (f.curves.empty() && f.failures.empty()) continue;
      Chart chart{"", std::move(f), "speed-accuracy"};
      if (kind.time) chart.text = input.scenes[i].question;
      if (auto table = cheapest_of(s, kind, input)) chart.tables.push_back(std::move(*table));
      if (!kind.time)
        for (const char* setting : {"step [s]", "tolerance [1]"})
          if (auto table = all_runs(s, setting)) chart.tables.push_back(std::move(*table));
      charts.push_back(std::move(chart));
    }
  }
  return charts;
}

}  // namespace crosscheck
