#include "report/findings/recommendation.h"

#include <algorithm>
#include <cmath>

#include "experiments/speed_accuracy/step_search.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

const Scene* main_scene(std::span<const Scene> scenes, const TableSet& rows) {
  const auto cheapest = rows_of<CheapestRow<Cost::cpu>>(rows);
  const Scene *any = nullptr, *cloth = nullptr;
  for (const Scene& scene : scenes) {
    const bool timed = std::ranges::any_of(cheapest, [&](const auto& row) {
      return row.scene == scene.name && row.measure == Measure::error && !row.method.value_or("").empty();
    });
    if (!timed) continue;
    any = &scene;
    if (!scene.triangles.empty() && scene.model.find<Springs>()) cloth = &scene;
  }
  return cloth ? cloth : any;
}

namespace {

/// Compares the cheapest run of each other engine with a run that takes `cpu` seconds of CPU time.
std::vector<EngineBeside> engines_beside(const std::string& scene, double part_of_motion, double cpu,
                                         const TableSet& rows) {
  std::vector<EngineBeside> all;
  for (const EngineSpeedRow& row : rows_of<EngineSpeedRow>(rows))
    if (row.scene == scene && std::abs(row.part_of_motion / part_of_motion - 1) < 1e-9 &&
        row.measure == Measure::error && row.times_mysim && is_rival(row.method))
      all.push_back({row.engine, row.method, row.cpu / cpu, row.part_timed == 1});
  return all;
}

}  // namespace

std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows) {
  const std::vector<SpeedAccuracyRow> table = rows_of<SpeedAccuracyRow>(rows);
  const auto any = std::ranges::find(table, scene, &SpeedAccuracyRow::scene);
  if (any == table.end() || !any->truth_bar) return std::nullopt;
  std::vector<TriedRun> runs = tried_runs(table, scene);
  // compare external programs by CPU time, because their force evaluations differ in cost from ours
  const auto is_outside = [](const TriedRun& run) { return family_of(run.method).role == Role::outside; };
  if (!std::ranges::all_of(runs, is_outside)) std::erase_if(runs, is_outside);
  const auto chosen = recommend(runs, part_of_motion * any->motion - *any->truth_bar);
  if (!chosen) return std::nullopt;
  const TriedRun& run = runs[chosen->run];
  const auto setting = run.setting.kind();
  for (const SpeedAccuracyCostRow& cost : rows_of<SpeedAccuracyCostRow>(rows)) {
    if (cost.scene != scene || cost.method != run.method || cost.setting != setting ||
        cost.requested != run.setting.value)
      continue;
    RecommendedRun out{.method = run.method,
                       .setting = setting,
                       .requested = run.setting.value,
                       .error = *run.error,
                       .motion = any->motion,
                       .error_bar = *any->truth_bar,
                       .tier = any->truth.value_or(""),
                       .evaluations = std::lround(run.cost),
                       .cost = cost.cpu,
                       .timed_whole = cost.part == 1,
                       .beside = engines_beside(scene, part_of_motion, cost.cpu, rows),
                       .bound = name_of(chosen->bound)};
    for (const size_t tie : chosen->tied) out.tied.push_back(runs[tie].method);
    return out;
  }
  return std::nullopt;
}

std::string setting_of(const RecommendedRun& run) {
  return (run.setting == SettingKind::step ? "step " : "") + setting_text(name_of(run.setting), run.requested);
}

Findings recommendation_findings(const Facts& facts) {
  const auto run = recommended_run(facts.scene->name, recommended_part, facts.rows);
  if (!run) return {};
  const double to_percent = 100 / run->motion;
  return {{.rule = "take",
           .scene = facts.scene->name,
           .method = run->method,
           .value = run->error * to_percent,
           .low = std::max(0., run->error - run->error_bar) * to_percent,
           .high = (run->error + run->error_bar) * to_percent,
           .tier = run->tier,
           .words = {{"setting", setting_of(*run)},
                     {"evaluations", count_text(run->evaluations)},
                     {"cpu", step_text(run->cost)},
                     {"bound", std::string(run->bound)},
                     {"tied", listed(names_in_sentence(run->tied))}}}};
}

}  // namespace crosscheck
