// Charts over all scenes: the error of every method as a table, and the fastest method at 1 % error.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "experiments/tables/matrix.h"
#include "experiments/tables/speed_accuracy.h"
#include "reference/engines/engines.h"
#include "report/figures/charts.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

std::vector<Chart> scoreboard_charts(const ChartInput& input) {
  PageTable table{
      "Largest error over time, RMS over the particles, in % of the motion; no less than the error bar of the "
      "reference solution",
      {"method"},
      {}};
  std::vector<const SceneData*> scenes;
  std::vector<std::string> methods;
  for (const SceneData& scene : input.facts) {
    if (scene.tier.empty() || !(scene.motion > 0)) continue;
    scenes.push_back(&scene), table.header.push_back(scene.scene);
    for (const MethodData& m : scene.methods)
      if (m.supported() && std::ranges::find(methods, m.method) == methods.end()) methods.push_back(m.method);
  }
  if (scenes.empty()) return {};
  for (const std::string& method : methods) {
    std::vector<std::string>& row = table.rows.emplace_back(std::vector{method});
    for (const SceneData* scene : scenes) {
      const MethodData* m = scene->find(method);
      row.push_back(!m || !m->supported() ? ""
                    : m->ok() && m->error ? percent(std::max(*m->error, scene->error_bar), scene->motion)
                    : m->ok()             ? ""
                                          : m->failure());
    }
  }
  return {{.figure = std::monostate(),
           .chapter = "speed-accuracy",
           .heading = "Error of each method at the scene's own time step",
           .tables = {std::move(table)}}};
}

namespace {

/// Replaces the rule by its usual name: "nearest: Heun", "symplectic Euler, implicit drag".
std::string words_of_rule(const std::string& words) {
  const size_t begin = words.starts_with("nearest: ") ? 9 : 0, end = std::min(words.find(','), words.size());
  const std::string rule = words.substr(begin, end - begin), method = fmt::format("{}/{}", subject().name, rule);
  return words.substr(0, begin) + (builtin_method(method) ? rule_name(method) : rule) + words.substr(end);
}

/// "-2.0e-4 ± 1e-6", "0 ± 1e-6", or the row's words.
template <class Row>
std::string cell_of(const Row& row) {
  const auto with_unit = [&](double value) { return row.unit == "s" ? step_text(value) : nice(value); };
  if (row.question == EngineQuestion::rule)
    return words_of_rule(row.words) + (row.value ? fmt::format(" ({})", nice(*row.value)) : "");
  if (!row.value || row.question == EngineQuestion::invariants || row.question == EngineQuestion::friction)
    return row.words;
  if (!row.bar) return with_unit(*row.value);
  const bool zero = std::abs(*row.value) <= *row.bar;
  return fmt::format("{} ± {}", zero ? "0" : with_unit(*row.value), with_unit(*row.bar));
}

}  // namespace

std::vector<Chart> matrix_charts(const ChartInput& input) {
  const auto rows = rows_of<MatrixRow<false>>(input.result);
  if (rows.empty()) return {};
  PageTable table{filled_text("engine-matrix", "caption"), {"method"}, {}};
  const auto [first, last] = range_of<EngineQuestion>;
  std::map<std::pair<std::string, EngineQuestion>, std::string> cells;
  for (const auto& row : rows) cells[{row.method, row.question}] = cell_of(row);
  for (const auto& row : rows_of<MatrixRow<true>>(input.result)) cells[{row.method, row.question}] = cell_of(row);
  // no column for the build: the first column contains it
  const int begin = static_cast<int>(first) + 1, end = static_cast<int>(last) + 1;
  static_assert(range_of<EngineQuestion>.first == EngineQuestion::build);
  for (int q = begin; q < end; ++q) table.header.emplace_back(name_of(static_cast<EngineQuestion>(q)));
  const std::vector<std::string> methods = distinct(rows, &MatrixRow<false>::method);
  for (const std::string& method : methods) {
    std::vector<std::string>& cells_of_row = table.rows.emplace_back(
        std::vector{family_of(method).role == Role::outside
                        ? fmt::format("{} ({})", program_title(method, methods), cells[{method, EngineQuestion::build}])
                        : method});
    for (int q = begin; q < end; ++q) cells_of_row.push_back(cells[{method, static_cast<EngineQuestion>(q)}]);
  }
  return {{.figure = std::monostate(),
           .chapter = "same-answer",
           .heading = filled_text("engine-matrix", "heading"),
           .tables = {std::move(table)}}};
}

std::vector<Chart> same_rule_charts(const ChartInput& input) {
  DotPlot f;
  std::vector<const MethodData*> shown;
  std::vector<std::string> methods;
  for (const MethodFamily* peer : default_peers()) methods.emplace_back(peer->representative);
  for (const SceneData& scene : input.facts)
    for (const MethodData& m : scene.methods)
      if (family_of(m.method).role == Role::outside && m.same_rule.value_or(false)) add_once(methods, m.method);
  for (const std::string& method : methods) {
    DotPlot::Series difference{method, style_of(method), {}}, bound{"round-off bound", {"#656e78", "1", 6}, {}};
    for (const SceneData& scene : input.facts) {
      const MethodData* m = scene.find(method);
      if (!m || !m->ok() || !m->same_rule.value_or(false) || !m->difference || !(*m->difference > 0)) continue;
      const std::string name = scene.touched() ? scene.scene + " (contact)" : scene.scene;
      const auto at = static_cast<size_t>(std::ranges::find(f.names, name) - f.names.begin());
      if (at == f.names.size()) f.names.push_back(name);
      const auto dot = [](double value) { return DotPlot::Dot{value, value, value}; };
      difference.dots.resize(f.names.size()), bound.dots.resize(f.names.size());
      difference.dots[at] = dot(*m->difference);
      if (m->round_off_bound && !scene.touched()) bound.dots[at] = dot(*m->round_off_bound);
      shown.push_back(m);
    }
    if (!difference.dots.empty()) f.series.push_back(std::move(difference));
    if (method == methods.front()) f.series.push_back(std::move(bound));
  }
  if (f.names.size() < 2) return {};  // a single scene needs no figure
  for (DotPlot::Series& series : f.series) series.dots.resize(f.names.size());
  const auto agreeing = std::ranges::count_if(
      shown, [](const MethodData* m) { return m->round_off_bound && *m->difference <= *m->round_off_bound; });
  Chart chart = described("same-rule-differences", std::move(f), "agreeing"_a = agreeing, "all"_a = shown.size(),
                          "commit"_a = input.commit);
  chart.shown = true;
  return {std::move(chart)};
}

// Cost at an accuracy: each engine's cheapest run within 1 % of the motion, relative to mysim's.

namespace {

std::pair<std::string, MethodStyle> style_of_engine(const std::string& engine) {
  const MethodFamily& family = family_of(engine);
  if (family.role == Role::outside) {
    const auto kept = kept_engine_of(engine);
    return {program_title(engine) + (kept && !kept->is_native() ? fmt::format(" ({})", kept->built) : ""),
            style_of(engine)};
  }
  if (family.representative.empty()) return {engine, style_of(engine)};
  return {std::string(family.title), style_of(std::string(family.representative))};
}

/// States how many ratios use a time that is scaled from a part of its run; empty if there are no such ratios.
std::string scaled_text(const std::vector<EngineSpeedRow>& rows) {
  int all = 0, scaled = 0;
  for (const EngineSpeedRow& row : rows)
    if (!family_of(row.engine).is_subject() && row.times_mysim)
      ++all, scaled += row.part_timed < 1 || row.part_timed_of_mysim.value_or(1) < 1;
  return scaled == 0 ? ""
                     : fmt::format("in {} of {} ratios a time is scaled from the first part of its run; ", scaled, all);
}

/// "For an error of 1 % mysim is the fastest on 10 of 11 scenes; Bullet takes 6.5 (rod) to 78 (spring) times its CPU
/// time."
std::string summary_of(const DotPlot& f) {
  size_t first = 0;
  for (size_t i = 0; i < f.names.size(); ++i)
    first += std::ranges::none_of(f.series, [i](const DotPlot::Series& s) { return s.dots[i] && s.dots[i]->low < 1; });
  std::string others;
  for (const DotPlot::Series& series : f.series) {
    std::optional<size_t> least, most;
    for (size_t i = 0; i < series.dots.size(); ++i) {
      if (!series.dots[i]) continue;
      if (!least || series.dots[i]->value < series.dots[*least]->value) least = i;
      if (!most || series.dots[i]->value > series.dots[*most]->value) most = i;
    }
    const auto at = [&](size_t i) { return fmt::format("{} ({})", times_text(series.dots[i]->value), f.names[i]); };
    others +=
        fmt::format("{} {} takes {}{}{}", others.empty() ? ";" : ",", series.title,
                    least == most ? "" : at(*least) + " to ", at(*most), others.empty() ? " times its CPU time" : "");
  }
  return fmt::format("For an error of 1 % mysim is the fastest, beyond the intervals, on {} of {} scenes{}.", first,
                     f.names.size(), others);
}

}  // namespace

std::vector<Chart> cheapest_charts(const ChartInput& input) {
  const auto table = rows_of<EngineSpeedRow>(input.result);
  std::vector<std::string> engines = distinct(table, &EngineSpeedRow::engine);
  std::erase(engines, subject().name);
  std::ranges::stable_partition(engines, [](const std::string& engine) { return family_of(engine).is_engine(); });
  std::vector<EngineSpeedRow> rows;
  std::ranges::copy_if(table, std::back_inserter(rows), [](const EngineSpeedRow& row) {
    return row.part_of_motion == 0.01 && row.measure == Measure::error;
  });
  DotPlot f;
  f.right_of_one = "mysim is faster";
  f.from_costs = true;
  std::vector<std::string> built{std::string(subject().name) + "/"};
  for (const EngineSpeedRow& row : rows)
    if (row.times_mysim && row.engine != subject().name && std::ranges::find(f.names, row.scene) == f.names.end())
      f.names.push_back(row.scene);
  if (f.names.empty()) return {};
  for (const std::string& engine : engines) {
    built.push_back(engine + "/");
    const auto [name, style] = style_of_engine(engine);
    DotPlot::Series series{name, style, std::vector<std::optional<DotPlot::Dot>>(f.names.size())};
    bool any = false;
    for (const EngineSpeedRow& row : rows | with(&EngineSpeedRow::engine, engine))
      if (row.times_mysim) {
        const auto line = std::ranges::find(f.names, row.scene) - f.names.begin();
        series.dots[static_cast<size_t>(line)] = {*row.times_mysim, *row.times_mysim_low, *row.times_mysim_high};
        any = true;
      }
    if (any) f.series.push_back(std::move(series));
  }
  f.finding = summary_of(f);
  return {described("cheapest-1-percent-cost", std::move(f), "scaled"_a = scaled_text(rows),
                    "builds"_a = builds_text(built), "commit"_a = input.commit)};
}

}  // namespace crosscheck
