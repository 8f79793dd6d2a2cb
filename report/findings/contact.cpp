// Findings of experiment `contact`, and on positions after contact.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/engines.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {

Findings cone_findings(const Facts& facts) {
  Findings out;
  const std::vector<ConeCount> planes = cone_counts(plane_cones(facts.rows));
  for (const ConeCount& count : cone_counts(rows_of<ConeRow>(facts.rows)))
    if (count.method == sticky_sphere || stands_for_its_engine(count.method)) {
      const ConeCount* flat = count_of(planes, count.method);
      out.push_back({.rule = "cone",
                     .method = count.method,
                     .value = double(count.right),
                     .words = {{"cases", std::to_string(count.all)},
                               {"planes", flat ? fmt::format("{} of {}", flat->right, flat->all) : ""}}});
    }
  return out;
}

/// Errors on planes at the usual step: those of mysim's representative, and the largest error of mysim's methods for a
/// particle that comes to rest.
Findings plane_findings(const Facts& facts) {
  const auto rows = rows_of<PlaneProbeRow>(facts.rows);
  if (rows.empty()) return {};
  const double step = usual_step(rows);
  Finding errs{.rule = "planes", .method = ours}, rests{.rule = "planes-rest", .method = std::string(subject().name)};
  std::vector<std::string> refused;
  std::string period, moving;
  double least = 1;
  for (const PlaneProbeRow& row : rows) {
    if (row.step != step) continue;
    if (row.verdict == Verdict::unsupported) add_once(refused, engine_of(row.method));
    if (!row.measured || !family_of(row.method).is_subject() || row.method == sticky_sphere) continue;
    const double off = std::abs(*row.measured - row.by_theory);
    if (row.probe == PlaneProbe::apex && row.method == ours) errs.value = 100 * off / row.by_theory;
    if (row.probe == PlaneProbe::period && row.method == ours) period = percent(off, row.by_theory);
    // J; smaller values are round-off
    if (row.probe == PlaneProbe::loss && off > 1e-12) rests.value = std::max(rests.value, 100 * off);
    if (row.probe == PlaneProbe::held && *row.measured < least) least = *row.measured, moving = row.method;
  }
  std::ranges::transform(refused, refused.begin(), name_in_sentence);
  errs.words = {{"step", step_text(step)}, {"period", period}, {"refused", joined(refused)}};
  rests.words = {{"moving", moving.empty() ? "" : name_in_sentence(moving)}, {"share", percent(least, 1)}};
  Findings out{std::move(rests)};
  if (!period.empty()) out.insert(out.begin(), std::move(errs));
  return out;
}

/// Positions after the comparison window: each other engine's final difference, next to the differences between mysim's
/// own rules. The latter show how far positions are predictable, because all rules of mysim share a contact rule. Uses
/// only rules that have an order above one and are stable without damping (Heun adds energy).
Findings contact_findings(const Facts& facts) {
  std::vector<std::string> scenes;
  for (const EngineRow& run : rows_of<EngineRow>(facts.rows)) add_once(scenes, run.scene);
  Findings out;
  for (const std::string& scene : scenes) {
    SceneData data = scene_data(scene, facts.rows);
    std::erase_if(data.methods, [](const MethodData& m) { return !m.ok(); });
    double duration = 0;
    for (const MethodData& run : data.methods) duration = std::max(duration, run.end);
    const Table* over_time = facts.rows.table(scene + "-engines");
    if (!over_time || !data.touched() || !(data.window < duration * (1 - 1e-9))) continue;
    std::map<std::string, double> apart;  // m, at the end
    for (const EngineTimeRow& row : rows_of<EngineTimeRow>(*over_time))
      if (row.difference) apart[row.method] = *row.difference;
    double least = INFINITY, most = 0;
    size_t rules = 0;
    for (const MethodData& run : data.methods)
      if (const Method* m = builtin_method(run.method);
          m && m->stepper && m->stepper->order >= 2 && m->stepper->limit(1, 0) > 0 && apart.contains(run.method)) {
        ++rules;
        least = std::min(least, apart.at(run.method)), most = std::max(most, apart.at(run.method));
      }
    if (rules < 2) continue;
    for (const MethodData& run : data.methods)
      if (apart.contains(run.method) && may_move_alike(run.method))
        out.push_back({.rule = "after-contact",
                       .scene = scene,
                       .method = ours,
                       .other = run.method,
                       .value = apart.at(run.method),
                       .words = {{"window", step_text(data.window)},
                                 {"rules", std::to_string(rules)},
                                 {"own", range(nice_length(least), nice_length(most))}}});
  }
  return out;
}

Findings leaving_findings(const Facts& facts) {
  std::map<std::string, std::map<double, double>> offs;  // degrees, by method and step
  std::vector<std::string> methods;
  double finest = INFINITY;
  for (const LeavingRow& row : rows_of<LeavingRow>(facts.rows)) {
    finest = std::min(finest, row.step);
    if (!row.angle) continue;
    if (!offs.contains(row.method)) methods.push_back(row.method);
    offs[row.method][row.step] = *row.angle - row.angle_by_theory;
  }
  Findings out;
  for (const std::string& method : methods) {
    const auto [step, off] = *offs[method].begin();
    if (step != finest) continue;
    Finding f{.rule = "leaving", .method = method, .value = off};
    f.words = {{"step", step_text(step)},
               {"longest", step_text(offs[method].rbegin()->first)},
               {"off", fmt::format("{:.2g} degrees", offs[method].rbegin()->second)}};
    // for mysim, keep only the method with the largest deviation
    const auto same = std::ranges::find_if(
        out, [&](const Finding& g) { return family_of(method).is_subject() && family_of(g.method).is_subject(); });
    if (same == out.end())
      out.push_back(std::move(f));
    else if (std::abs(off) > std::abs(same->value))
      *same = std::move(f);
  }
  return out;
}

Findings drape_findings(const Facts& facts) {
  std::vector<DrapeRow> ends = rows_of<DrapeRow>(facts.rows);
  std::erase_if(ends, [](const DrapeRow& row) {
    return row.scene != "drop-aside" || row.verdict != Verdict::ok ||
           (row.method != sticky_sphere && !stands_for_its_engine(row.method));
  });
  double finest = INFINITY;
  for (const DrapeRow& row : ends)
    if (row.method == ours) finest = std::min(finest, row.step);
  Findings out;
  for (const DrapeRow& row : ends)
    if (std::abs(row.step / finest - 1) < 1e-6)
      out.push_back({.rule = row.creep ? "still-touches" : "slides-off",
                     .method = row.method,
                     .value = row.creep ? (*row.creep < 1e-6 ? 0 : *row.creep) : row.centre_height.value_or(0),
                     .words = {{"end", step_text(row.end)}}});
  return out;
}

}  // namespace crosscheck
