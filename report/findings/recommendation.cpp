#include "report/findings/recommendation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/speed_accuracy/work_precision.h"
#include "mysim/base/text.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

const Scene* main_scene(const std::vector<Scene>& scenes, const TableSet& rows) {
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

bool is_part(double part, double asked) { return std::abs(part / asked - 1) < 1e-9; }

std::vector<EngineBeside> engines_beside(const std::string& scene, double part_of_motion, const TableSet& rows) {
  std::vector<EngineBeside> all;
  for (const EngineSpeedRow& row : rows_of<EngineSpeedRow>(rows))
    if (row.scene == scene && is_part(row.part_of_motion, part_of_motion) && row.measure == Measure::error &&
        row.times_mysim && is_rival(row.method))
      all.push_back({row.engine, row.method, *row.times_mysim, row.times_mysim_low.value_or(*row.times_mysim),
                     row.times_mysim_high.value_or(*row.times_mysim)});
  return all;
}

}  // namespace

std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows) {
  const auto cheapest = rows_of<CheapestRow<Cost::cpu>>(rows);
  const auto row = std::ranges::find_if(cheapest, [&](const auto& r) {
    return r.scene == scene && is_part(r.part_of_motion, part_of_motion) && r.measure == Measure::error;
  });
  if (row == cheapest.end() || row->method.value_or("").empty()) return std::nullopt;
  const std::vector<SpeedAccuracyRow> runs = rows_of<SpeedAccuracyRow>(rows);
  const std::vector<SpeedAccuracyCostRow> costs = rows_of<SpeedAccuracyCostRow>(rows);
  RecommendedRun best{.method = *row->method,
                      .setting = *row->setting,
                      .requested = *row->requested,
                      .error = *row->distance,
                      .tier = {},
                      .cost = *row->cost,
                      .tied = {},
                      .beside = engines_beside(scene, part_of_motion, rows),
                      .bound = "sampling"};
  // of those that the clock cannot tell apart the nearest
  const auto cost_of = [&](const SpeedAccuracyRow& run) -> std::optional<double> {
    for (const SpeedAccuracyCostRow& cost : costs)
      if (cost.scene == run.scene && cost.method == run.method && cost.setting == run.setting &&
          cost.requested == run.requested)
        return cost.cpu;
    return std::nullopt;
  };
  std::vector<std::string> tied{best.method};
  if (!row->tied.value_or("").empty())
    for (const std::string& name : split(*row->tied, ','))
      tied.push_back(name.substr(std::min(name.size(), name.find_first_not_of(' '))));
  for (const std::string& method : tied) {
    const SpeedAccuracyRow* own = nullptr;
    for (const SpeedAccuracyRow& run : runs) {
      if (run.scene != scene || run.method != method || run.verdict != Verdict::ok || !run.error) continue;
      best.motion = run.motion, best.error_bar = run.truth_bar.value_or(0), best.tier = run.truth.value_or("");
      const auto cost = cost_of(run);
      if (*run.error <= row->bound && cost && (!own || *cost < *cost_of(*own))) own = &run;
    }
    if (!own || method == best.method) continue;
    if (*own->error < best.error) {
      best.tied.push_back(best.method);
      best.method = method, best.setting = own->setting, best.requested = own->requested, best.error = *own->error;
      best.cost = *cost_of(*own);
    } else {
      best.tied.push_back(method);
    }
  }
  // the next longer step of the same method that does not meet the bound
  double next = std::numeric_limits<double>::infinity();
  for (const SpeedAccuracyRow& run : runs)
    if (run.scene == scene && run.method == best.method && run.setting == best.setting &&
        run.requested > best.requested && run.requested < next &&
        !(run.verdict == Verdict::ok && run.error && *run.error <= row->bound))
      next = run.requested, best.bound = run.verdict == Verdict::ok ? "accuracy" : "stability";
  return best;
}

std::string setting_of(const RecommendedRun& run) {
  return (run.setting == SettingKind::step ? "step " : "") +
         setting_text(std::string(name_of(run.setting)), run.requested);
}

std::string speed_text(const RecommendedRun& run, const Scene& scene) {
  const double factor = scene.duration / run.cost;
  return factor >= 1 ? times_text(factor) + " times faster" : times_text(1 / factor) + " times slower";
}

std::vector<Finding> recommendation_findings(const Scene& scene, const TableSet& rows) {
  const auto run = recommended_run(scene.name, 0.01, rows);
  if (!run) return {};
  const double to_percent = 100 / run->motion;
  std::vector<Finding> out{
      {.rule = "take",
       .scene = scene.name,
       .method = run->method,
       .value = run->error * to_percent,
       .low = std::max(0., run->error - run->error_bar) * to_percent,
       .high = (run->error + run->error_bar) * to_percent,
       .tier = run->tier,
       .words = {
           {"setting", setting_of(*run)}, {"speed", speed_text(*run, scene)}, {"bound", std::string(run->bound)}}}};
  std::vector<std::string> tied;
  for (const std::string& method : run->tied) tied.push_back(name_in_sentence(method));
  if (!tied.empty())
    out.push_back({.rule = "take-tied",
                   .scene = scene.name,
                   .method = run->method,
                   .value = static_cast<double>(tied.size()),
                   .words = {{"which", listed(tied)}}});
  for (const EngineBeside& engine : run->beside)
    out.push_back({.rule = "take-beside",
                   .scene = scene.name,
                   .method = std::string(subject().name),
                   .other = engine.engine,
                   .value = engine.times,
                   .low = engine.low,
                   .high = engine.high});
  return out;
}

}  // namespace crosscheck
