// Error against cost, in evaluations and in CPU time: all methods, the Pareto front, the truth's error bar and failed
// runs. The finding of each figure names the methods on the front.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "reference/engines/engines.h"
#include "report/figures/charts.h"
#include "report/findings/answers.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

using Row = SpeedAccuracyRow;

struct SceneRuns {
  std::vector<Row> runs;
  std::vector<SpeedAccuracyCostRow> costs;
  std::string scene, truth;
  double motion = 0;
  std::optional<double> error_bar;

  bool difference() const { return truth.find("contact rule") != std::string::npos; }
  /// Unit of the axis, m: a hundredth of the motion if a truth is known.
  double unit() const { return error_bar && motion > 0 ? motion / 100 : 1; }
  OptionalNumber drawn(const Row& run) const {
    return !error_bar ? run.to_own_finest : difference() ? run.difference : run.error;
  }
  std::string measure() const {
    return !error_bar     ? "difference from own finest run"
           : difference() ? "difference from mysim's contact rule"
                          : "error";
  }
  const SpeedAccuracyCostRow* timing(const Row& run) const {
    const auto found = std::ranges::find_if(costs, [&](const SpeedAccuracyCostRow& c) {
      return c.method == run.method && c.setting == run.setting && c.requested == run.requested;
    });
    return found == costs.end() ? nullptr : &*found;
  }
  std::optional<double> cost(const Row& run, bool time) const {
    if (!time) return static_cast<double>(run.evaluations);
    const SpeedAccuracyCostRow* timed = timing(run);
    return timed ? std::optional(timed->cpu) : std::nullopt;
  }
  /// True if only a part of the run was timed; the time of that part is scaled by evaluations (for Bullet's worlds: by
  /// steps).
  bool is_scaled(const Row& run) const {
    const SpeedAccuracyCostRow* timed = timing(run);
    return timed && timed->part < 1;
  }
};

std::string cost_text(double value, bool time) {
  return time ? step_text(value) : value < 1e6 ? fmt::format("{:.0f}", value) : nice(value);
}

SceneRuns runs_of(const ChartInput& input, const std::string& scene) {
  SceneRuns s;
  s.scene = scene;
  std::ranges::copy(rows_of<Row>(input.result) | with(&Row::scene, scene), std::back_inserter(s.runs));
  std::ranges::copy(rows_of<SpeedAccuracyCostRow>(input.result) | with(&SpeedAccuracyCostRow::scene, scene),
                    std::back_inserter(s.costs));
  for (const Row& run : s.runs) s.motion = run.motion, s.error_bar = run.truth_bar, s.truth = run.truth.value_or("");
  return s;
}

/// "mysim/rk4 3" is the method's fourth row in this scene.
std::string name_of_run(const SceneRuns& s, const Row& run) {
  const auto place = std::count_if(s.runs.data(), &run, [&](const Row& other) { return other.method == run.method; });
  return fmt::format("{} {}", run.method, place);
}

Tooltip tooltip(const SceneRuns& s, const Row& run, const std::string& outcome) {
  std::string costs;
  for (const bool time : {false, true})
    if (const auto value = s.cost(run, time); value && *value > 0)
      costs += fmt::format("{}{} {}", costs.empty() ? "" : ", ", cost_text(*value, time),
                           !time              ? "evaluations"
                           : s.is_scaled(run) ? "of CPU (scaled from a part of the run)"
                                              : "of CPU");
  return {fmt::format("{}, {}{}\n{}\n{}", without_folders(run.method), run.setting == SettingKind::step ? "step " : "",
                      setting_text(std::string(name_of(run.setting)), run.requested), outcome, costs),
          name_of_run(s, run)};
}

constexpr int scaled_ring = 6;  // open circle

int cross_of(const std::string& word) { return word == "blew up" ? 2 : word == "solver gave up" ? 1 : 3; }

/// "2/ω" for h omega = 2
std::string over_omega(double h_omega) {
  return (std::abs(h_omega - 2) < 0.005 ? std::string("2") : nice(h_omega)) + "/ω";
}

/// Marks the recommended run, the cost at its rule's critical step, and real time.
void add_recommendation(Figure& f, const SceneRuns& s, bool time, const ChartInput& input) {
  const auto scene = std::ranges::find(input.scenes, s.scene, &Scene::name);
  if (time && scene != input.scenes.end()) f.guides.push_back({true, scene->duration, "real time"});
  const auto best = recommended_run(s.scene, 0.01, input.result);
  if (!best) return;
  for (const Row& run : s.runs) {
    const auto cost = s.cost(run, time);
    if (!cost || run.method != best->method || run.setting != best->setting || run.requested != best->requested)
      continue;
    f.on_page.take = {*cost, std::max(best->error, s.error_bar.value_or(0)) / s.unit(),
                      "recommended: " + setting_text(std::string(name_of(run.setting)), run.requested),
                      fmt::format("{}, {}{}", percent(best->error, best->motion), cost_text(*cost, time),
                                  time ? "" : " evaluations")};
    for (const LimitRow& limit : rows_of<LimitRow>(input.result))
      if (run.setting == SettingKind::step && limit.scene == s.scene && limit.method == run.method && limit.predicted &&
          *limit.predicted > 0 && limit.omega)
        f.guides.push_back({true, *cost * run.requested / *limit.predicted,
                            fmt::format("{} blows up left of here: h > {} = {}", short_name(run.method),
                                        over_omega(*limit.predicted * *limit.omega), step_text(*limit.predicted))});
  }
}

/// The methods on the front, from the cheapest run to the most accurate.
template <Cost kind>
std::vector<std::string> add_front(Figure& f, const SceneRuns& s, const ChartInput& input) {
  std::vector<std::string> methods;
  for (const auto& row : rows_of<ParetoRow<kind>>(input.result) | with(&ParetoRow<kind>::scene, s.scene)) {
    f.pareto.emplace_back(row.cost, std::min(3 * s.motion, row.distance) / s.unit());
    const std::string name = name_in_sentence(row.method);
    if (std::ranges::find(methods, name) == methods.end()) methods.push_back(name);
  }
  return methods;
}

std::optional<Chart> chart_of(const SceneRuns& s, bool time, const ChartInput& input) {
  Figure f;
  f.from_costs = time;
  f.runs = s.scene + "-speed-accuracy";
  f.x = {"CPU time of the run / s", true};
  const double unit = s.unit(), top = 10 * s.motion / unit, highest = 3 * s.motion / unit;
  double lowest = s.error_bar ? std::max(*s.error_bar, 1e-16) / unit : 1, furthest = 0;
  size_t good = 0;
  int beyond = 0, uncounted = 0;
  // rings around scaled times; drawn beneath all methods, so that the pointer finds the run's own mark
  Curve scaled{scaled_times, {"#777777", "1", scaled_ring}, {}, false, true};
  std::set<std::string> methods;
  for (const Row& run : s.runs) {
    const auto cost = s.cost(run, time);
    if (!cost || !(*cost > 0)) {
      uncounted += run.verdict != Verdict::unsupported;
      continue;
    }
    methods.insert(run.method);
    furthest = std::max(furthest, *cost);
    const bool part = time && s.is_scaled(run);
    if (run.verdict != Verdict::ok) {
      if (part) scaled.points.emplace_back(*cost, 4 * s.motion / unit);
      const std::string word = failure_class(run.verdict);
      f.failures.push_back({run.method + ": " + word, style_of(run.method), *cost, 4 * s.motion / unit, word,
                            cross_of(word), tooltip(s, run, fmt::format("{} at {:.3g} s", word, run.end))});
      continue;
    }
    const auto apart = s.drawn(run);
    if (!apart || (!s.error_bar && !(*apart > 0))) continue;
    // errors below the truth's error bar are unknown
    const double y = std::min(highest, std::max(*apart, s.error_bar.value_or(0)) / unit);
    beyond += *apart > highest * unit;
    Curve& curve = curve_of(f, run.method, style_of(run.method));
    curve.points.emplace_back(*cost, y);
    curve.tooltips.push_back(tooltip(s, run, s.measure() + " " + nice_length(*apart)));
    if (part) scaled.points.emplace_back(*cost, y);
    lowest = std::min(lowest, y);
    ++good;
  }
  if (f.curves.empty() && f.failures.empty()) return std::nullopt;
  const size_t failed = f.failures.size();
  f.y = {fmt::format("largest RMS position {} / {}", s.error_bar && !s.difference() ? "error" : "difference",
                     s.error_bar && s.motion > 0 ? "% of the motion" : "m"),
         true, lowest / 3, top};
  const std::vector<std::string> best =
      time ? add_front<Cost::cpu>(f, s, input) : add_front<Cost::evaluations>(f, s, input);
  if (!f.pareto.empty()) f.pareto.emplace_back(furthest, f.pareto.back().second);
  if (s.error_bar && s.motion > 0) {
    f.cut = 2e-6 * s.motion / unit;
    add_recommendation(f, s, time, input);
  }
  if (s.error_bar)
    f.floor = {s.difference() ? "error bar of the converged contact rule" : "error bar of the reference",
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
  f.tier = s.error_bar ? fmt::format("{}, error bar {}", s.truth, nice_length(*s.error_bar))
                       : "each method's own finest run, because no reference solution is known";
  return described(time ? "{scene}-speed-accuracy-cost" : "{scene}-speed-accuracy", std::move(f), "scene"_a = s.scene,
                   "motion"_a = nice_length(s.motion), "drawn"_a = drawn,
                   "builds"_a = builds_text({methods.begin(), methods.end()}), "commit"_a = input.commit);
}

}  // namespace

std::vector<Chart> speed_accuracy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (const Scene& scene : input.scenes) {
    if (!has_own_charts("speed-accuracy", scene.name, input.all)) continue;
    const SceneRuns runs = runs_of(input, scene.name);
    for (const bool time : {true, false})
      if (auto chart = chart_of(runs, time, input)) {
        if (time) chart->text = scene.question;
        charts.push_back(std::move(*chart));
      }
  }
  return charts;
}

}  // namespace crosscheck
