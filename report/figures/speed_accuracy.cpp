// Error against cost, once in evaluations and once in CPU time: curves of all methods, the Pareto line, the floor of
// the truth, crosses for failed runs; and with each figure the cheapest methods.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/tables/stability.h"
#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/answers.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

bool same_run(const Table& a, size_t i, const Table& b, size_t j) {
  for (const char* column : {"scene", "method", "setting", "asked"})
    if (a.at(i, column) != b.at(j, column)) return false;
  return true;
}

/// The cost on the x axis of a chart: CPU time or force evaluations.
struct CostAxis {
  bool time;
  std::string suffix() const { return time ? "-cost" : ""; }
  std::string column() const { return time ? "cpu" : "evaluations"; }
  std::string text_of(double value) const {
    return time ? step_text(value) : value < 1e6 ? fmt::format("{:.0f}", value) : nice(value);
  }
};

/// The rows of one scene, and its truth.
struct SceneRows {
  const Table& runs;
  const Table* cost;  // of CPU times
  std::string scene, truth;
  std::vector<size_t> rows;
  double motion = 0;
  std::optional<double> error_bar;
  bool difference() const { return truth.find("contact rule") != std::string::npos; }
  /// Length that counts as one on the axis, m: a percent of the motion where a truth is known.
  double unit() const { return error_bar && motion > 0 ? motion / 100 : 1; }
  /// The quantity drawn over the cost.
  const char* column() const {
    return !error_bar     ? "distance to own finest"
           : difference() ? "largest difference from converged contact"
                          : "largest error";
  }
  std::string measure() const {
    return !error_bar     ? "difference from own finest run"
           : difference() ? "difference from the in-house contact rule"
                          : "error";
  }
  std::optional<double> cost_of(size_t row, const CostAxis& kind) const {
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

/// The tooltip of a run, in three lines.
Tooltip tooltips(const SceneRows& s, size_t row, const std::string& outcome) {
  std::string cost;
  for (const CostAxis kind : {CostAxis{false}, CostAxis{true}})
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

/// "2/ω": a limit in h omega over the frequency.
std::string over_omega(double h_omega) {
  return (std::abs(h_omega - 2) < 0.005 ? std::string("2") : nice(h_omega)) + "/ω";
}

/// Marks the recommended run, the cost of the critical step of its rule, and real time.
void add_recommendation(Figure& f, const SceneRows& s, const CostAxis& kind, const ChartInput& input) {
  const auto scene = std::ranges::find(input.scenes, s.scene, &Scene::name);
  if (kind.time && scene != input.scenes.end()) f.guides.push_back({true, scene->duration, "real time"});
  const auto run = recommended_run(s.scene, 0.01, input.result);
  if (!run) return;
  for (const size_t i : s.rows) {
    const std::string setting(name_of(run->setting));
    const auto cost = s.cost_of(i, kind);
    if (!cost || text_or_none(s.runs, i, "method") != run->method || text_or_none(s.runs, i, "setting") != setting ||
        number_at(s.runs, i, "asked") != run->requested)
      continue;
    f.on_page.take = {*cost, std::max(run->error, s.error_bar.value_or(0)) / s.unit(),
                      "take this: " + setting_text(setting, run->requested),
                      fmt::format("{}, {}", percent(run->error, run->motion), kind.text_of(*cost))};
    if (!kind.time) f.on_page.take->more += " evaluations";
    for (const LimitRow& limit : rows_of<LimitRow>(input.result))
      if (run->setting == SettingKind::step && limit.scene == s.scene && limit.method == run->method &&
          limit.predicted && *limit.predicted > 0 && limit.omega)
        f.guides.push_back({true, *cost * run->requested / *limit.predicted,
                            fmt::format("{} blows up left of here: h > {} = {}", short_name(run->method),
                                        over_omega(*limit.predicted * *limit.omega), step_text(*limit.predicted))});
  }
}

Figure figure_of(const SceneRows& s, const CostAxis& kind, const ChartInput& input) {
  Figure f;
  f.name = s.scene + "-speed-accuracy" + kind.suffix();
  f.from_costs = kind.time;
  f.runs = s.scene + "-speed-accuracy";
  f.title = fmt::format("{}: work-precision diagram over {}", s.scene, kind.time ? "CPU time" : "force evaluations");
  f.x = {kind.time ? "CPU time of the run / s" : "force evaluations of the run", true, std::nullopt, std::nullopt};
  const double unit = s.unit(), top = 10 * s.motion / unit, highest = 3 * s.motion / unit;
  double lowest = s.error_bar ? std::max(*s.error_bar, 1e-16) / unit : 1, furthest = 0;
  int failed = 0, good = 0, beyond = 0, uncounted = 0;
  // in a style of its own, and beneath all methods, so that a pointer meets the run
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
      if (part) scaled.points.emplace_back(*cost, 4 * s.motion / unit);
      const std::string word = failure_class(verdict);
      f.failures.push_back({method + ": " + word, style_of(method), *cost, 4 * s.motion / unit, word, cross_of(word),
                            tooltips(s, i, fmt::format("{} at {:.3g} s", word, *number_at(s.runs, i, "end")))});
      ++failed;
      continue;
    }
    const auto apart = number_at(s.runs, i, s.column());
    if (!apart || (!s.error_bar && !(*apart > 0))) continue;
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == method; });
    if (curve == f.curves.end()) curve = f.curves.insert(f.curves.end(), {method, style_of(method), {}, true, true});
    // errors below the truth's error bar are not known
    const double y = std::min(highest, (s.error_bar ? std::max(*apart, *s.error_bar) : *apart) / unit);
    beyond += *apart > highest * unit;
    curve->points.emplace_back(*cost, y);
    if (part) scaled.points.emplace_back(*cost, y);
    curve->tooltips.push_back(tooltips(s, i, s.measure() + " " + nice_length(*apart)));
    lowest = std::min(lowest, y);
    ++good;
  }
  f.y = {fmt::format("largest RMS position {} / {}", s.error_bar && !s.difference() ? "error" : "difference",
                     s.error_bar && s.motion > 0 ? "% of the motion" : "m"),
         true, lowest / 3, top};
  std::vector<std::string> best;  // methods of the line, from the cheapest run to the most accurate
  if (const Table* pareto = input.result.table("speed-accuracy-pareto" + kind.suffix()))
    for (size_t i = 0; i < pareto->rows.size(); ++i)
      if (text_or_none(*pareto, i, "scene") == s.scene) {
        f.pareto.emplace_back(*number_at(*pareto, i, kind.column().c_str()),
                              std::min(highest, *number_at(*pareto, i, "distance") / unit));
        const std::string name = name_in_sentence(text_at(*pareto, i, "method"));
        if (std::ranges::find(best, name) == best.end()) best.push_back(name);
      }
  if (!f.pareto.empty()) f.pareto.emplace_back(furthest, f.pareto.back().second);
  if (s.error_bar && s.motion > 0) {
    f.cut = 2e-6 * s.motion / unit;
    add_recommendation(f, s, kind, input);
  }
  if (s.error_bar)
    f.floor = {s.difference() ? "error bar of the converged contact rule" : "error bar of the truth",
               *s.error_bar / unit};
  f.finding = fmt::format("{}{} runs of {} methods; {} failed.",
                          best.empty() ? "" : fmt::format("Pareto front: {}. ", fmt::join(best, ", ")), good + failed,
                          methods.size(), failed);
  std::string drawn;
  if (beyond > 0)
    drawn = fmt::format("{} above three times the motion ({}), drawn there; ", beyond, nice_length(3 * s.motion));
  if (!scaled.points.empty()) {
    f.x.label = "CPU time of the run, ringed: scaled from a part of it / s";
    drawn +=
        fmt::format("{} of {} times (open marks) scaled from a part of the run; ", scaled.points.size(), good + failed);
    f.curves.insert(f.curves.begin(), std::move(scaled));
  }
  if (uncounted > 0) drawn += fmt::format("{} of unknown cost, not drawn; ", uncounted);
  f.caption = fmt::format("Scene {}, motion {}; {}{}commit {}.", s.scene, nice_length(s.motion),
                          kind.time ? "CPU time, medians of runs in turns on one core; " +
                                          builds_text({methods.begin(), methods.end()}) + "; "
                                    : "",
                          drawn, input.commit);
  f.tier = s.error_bar ? fmt::format("{}{}, error bar {}", s.difference() ? "" : "the truth: ", s.truth,
                                     nice_length(*s.error_bar))
                       : "each method's own finest run, since no truth is known";
  return f;
}

}  // namespace

std::vector<Chart> speed_accuracy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* runs = input.result.table("speed-accuracy");
  for (size_t i = 0; runs && i < input.scenes.size(); ++i) {
    if (!has_own_charts("speed-accuracy", input.scenes[i].name, input.all)) continue;
    const SceneRows s = rows_of(input, *runs, input.scenes[i].name);
    if (s.rows.empty()) continue;
    for (const CostAxis kind : {CostAxis{true}, CostAxis{false}}) {
      Figure f = figure_of(s, kind, input);
      if (f.curves.empty() && f.failures.empty()) continue;
      Chart chart{"", std::move(f), "speed-accuracy"};
      if (kind.time) chart.text = input.scenes[i].question;
      charts.push_back(std::move(chart));
    }
  }
  return charts;
}

}  // namespace crosscheck
