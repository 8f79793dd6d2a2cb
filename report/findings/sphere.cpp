// Findings of experiment `sphere`, and of what engines do after contact.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/sphere.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

void cone(const TableSet& rows, std::vector<Finding>& out) {
  for (const ConeCount& count : cone_counts(rows))
    if (count.method == sticky_sphere || stands_for_its_engine(count.method))
      out.push_back({.rule = "cone",
                     .method = count.method,
                     .value = static_cast<double>(count.right),
                     .words = {{"cases", std::to_string(count.all)}}});
}

/// Largest difference from mysim/symplectic-euler that each method's rows of a scene show, m, by method.
std::map<std::string, double> differences_over_run(const Table& rows) {
  std::map<std::string, double> largest;
  for (const EngineTimeRow& row : rows_of<EngineTimeRow>(rows))
    if (row.difference) largest[row.method] = std::max(largest[row.method], *row.difference);
  return largest;
}

/// The lengths of a motion's end, of perturbed runs of mysim's representative and of all methods: where positions can
/// be held against nothing. None without a spread.
std::optional<Finding> final_lengths(const TableSet& rows, const std::string& scene, const std::string& why) {
  const Table* table = rows.table(scene + "-statistics");
  if (!table) return std::nullopt;
  const std::vector<StatisticRow> all = rows_of<StatisticRow>(*table);
  Finding f{.rule = "final-lengths", .scene = scene, .other = ours, .value = 0};
  double spread = 0;
  for (const StatisticRow& of_ours : all) {
    if (of_ours.method != ours || of_ours.unit != "m" || !of_ours.quantity.ends_with(" at the end")) continue;
    spread = std::max(spread, of_ours.deviation.value_or(0));
    for (const StatisticRow& row : all)
      if (const double apart = std::abs(row.mean - of_ours.mean);
          row.quantity == of_ours.quantity && row.method != sticky_sphere && apart > f.value)
        f.value = apart, f.method = row.method;
  }
  if (!(spread > 0) || f.method.empty()) return std::nullopt;
  f.words = {{"why", why}, {"spread", nice_length(spread)}};
  return f;
}

/// Single positions after the window: mysim's own rules of an order above one, which share its contact
/// rule, say whether they can be predicted. They part by what their steps err and by what grows of it; where that stays
/// small against the difference of another engine, it is its result that differs, and no chance. Otherwise, and where
/// there is no truth, the end's lengths are held against those of perturbed runs.
void after_contact(const TableSet& rows, std::vector<Finding>& out) {
  std::map<std::string, std::vector<EngineRow>> runs;  // by scene
  std::vector<std::string> scenes;
  for (EngineRow& run : rows_of<EngineRow>(rows))
    if (run.verdict == Verdict::ok) {
      if (!runs.contains(run.scene)) scenes.push_back(run.scene);
      runs[run.scene].push_back(std::move(run));
    }
  for (const std::string& scene : scenes) {
    const Table* over_time = rows.table(scene + "-engines");
    double duration = 0, own = 0;
    bool touched = false;
    size_t rules = 0;
    for (const EngineRow& run : runs[scene])
      duration = std::max(duration, run.end), touched |= run.clearance.value_or(1) < 1e-3;
    const double window = runs[scene][0].window;
    if (!over_time || !touched) continue;
    const EngineRow& any = runs[scene][0];
    if (!(window < duration * (1 - 1e-9))) {
      if (const auto f = any.truth ? std::nullopt : final_lengths(rows, scene, "no truth is known")) out.push_back(*f);
      continue;
    }
    const auto apart = differences_over_run(*over_time);
    for (const EngineRow& run : runs[scene])
      if (const Method* m = builtin_method(run.method); m && m->stepper && m->stepper->order >= 2) {
        ++rules;
        if (const auto found = apart.find(run.method); found != apart.end()) own = std::max(own, found->second);
      }
    if (rules < 2) continue;
    std::vector<Finding> said;
    bool differ = false;
    for (const EngineRow& run : runs[scene])
      if (const auto other = apart.find(run.method); other != apart.end() && is_another_engine(run.method) &&
                                                     stands_for_its_engine(run.method) &&
                                                     run.method != position_based(family_of(run.method))) {
        // three times: beyond what one more rule of the kind might add
        const bool differs = other->second > 3 * own;
        differ |= differs;
        said.push_back(
            {.rule = differs ? "after-contact" : "after-contact-open",
             .scene = scene,
             .method = ours,
             .other = run.method,
             .value = other->second,
             .words = {{"window", step_text(window)}, {"rules", std::to_string(rules)}, {"own", nice_length(own)}}});
      }
    const bool known_to_the_end = any.truth && !any.truth_until;
    if (const auto f = final_lengths(rows, scene, "beyond " + step_text(window) + " positions say nothing");
        f && !differ && !known_to_the_end)
      said = {*f};
    out.insert(out.end(), said.begin(), said.end());
  }
}

/// By engine, the deepest of its methods.
void penetration(const TableSet& rows, std::vector<Finding>& out) {
  std::vector<Finding> all;
  std::vector<double> triangles;
  for (const PenetrationRow& row : rows_of<PenetrationRow>(rows)) {
    if (row.verdict != Verdict::ok || !row.particles || row.method == sticky_sphere) continue;
    auto f = std::ranges::find_if(
        all, [&](const Finding& other) { return engine_of(other.method) == engine_of(row.method); });
    if (f == all.end()) f = all.insert(all.end(), {.rule = "penetration", .value = -1}), triangles.push_back(0);
    double& deepest = triangles[static_cast<size_t>(f - all.begin())];
    deepest = std::max(deepest, row.triangles.value_or(0));
    const double depth = *row.particles < 1e-9 ? 0 : *row.particles;  // round-off
    if (depth > f->value) f->value = depth, f->method = row.method;
    f->words = {{"triangles", percent(deepest, 100)}};
  }
  for (size_t i = 0; i < all.size(); ++i)
    if (all[i].value == 0)
      all[i] = {.rule = "penetration-of-triangles", .method = engine_of(all[i].method), .value = triangles[i]};
  out.insert(out.end(), all.begin(), all.end());
}

}  // namespace

std::vector<Finding> leaving_findings(const Table& table) {
  std::map<std::string, std::map<double, double>> offs;  // by method and step: degrees
  std::vector<std::string> methods;
  double finest = INFINITY;
  for (const LeavingRow& row : rows_of<LeavingRow>(table)) {
    finest = std::min(finest, row.step);
    if (!row.angle) continue;
    if (!offs.contains(row.method)) methods.push_back(row.method);
    offs[row.method][row.step] = *row.angle - row.angle_by_theory;
  }
  std::vector<Finding> out;
  for (const std::string& method : methods) {
    const auto [step, off] = *offs[method].begin();
    const double at_longest = offs[method].rbegin()->second;
    if (step != finest) continue;
    Finding f{.rule = "leaving", .method = method, .value = off};
    f.words = {{"step", step_text(step)},
               {"off", fmt::format("{:.2g} degrees too {}", std::abs(off), off < 0 ? "early" : "late")},
               {"which", family_of(method).is_subject() ? ", the furthest of mysim" : ""},
               {"worse", std::abs(off) > std::abs(at_longest) ? ": shorter steps make it worse" : ""}};
    // of mysim's the furthest
    const auto same = std::ranges::find_if(
        out, [&](const Finding& g) { return family_of(method).is_subject() && family_of(g.method).is_subject(); });
    if (same == out.end())
      out.push_back(std::move(f));
    else if (std::abs(off) > std::abs(same->value))
      *same = std::move(f);
  }
  return out;
}

std::vector<Finding> drape_findings(const Table& table) {
  std::vector<DrapeRow> ends = rows_of<DrapeRow>(table);
  std::erase_if(ends, [](const DrapeRow& row) {
    return row.scene != "drop-aside" || row.verdict != Verdict::ok ||
           (row.method != sticky_sphere && !stands_for_its_engine(row.method));
  });
  double finest = INFINITY;
  for (const DrapeRow& row : ends)
    if (row.method == ours) finest = std::min(finest, row.step);
  std::vector<Finding> out;
  for (const DrapeRow& row : ends)
    if (std::abs(row.step / finest - 1) < 1e-6)
      out.push_back({.rule = row.creep ? "still-touches" : "slides-off",
                     .method = row.method,
                     .value = row.creep ? (*row.creep < 1e-6 ? 0 : *row.creep) : row.centre_height.value_or(0),
                     .words = {{"end", step_text(row.end)}}});
  return out;
}

std::vector<Finding> sphere_findings(const TableSet& rows) {
  std::vector<Finding> out;
  after_contact(rows, out);
  cone(rows, out);
  for (const auto& [name, findings_of_table] :
       {std::pair{LeavingRow::table, &leaving_findings}, {DrapeRow::table, &drape_findings}})
    if (const Table* table = rows.table(std::string(name)))
      for (Finding& f : findings_of_table(*table)) out.push_back(std::move(f));
  penetration(rows, out);
  return out;
}

}  // namespace crosscheck
