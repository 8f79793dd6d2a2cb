// Findings of the search for the largest stable steps.

#include <algorithm>
#include <cmath>
#include <map>

#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {

std::vector<Finding> limit_findings(const TableSet& rows) {
  const std::vector<LimitRow> table = rows_of<LimitRow>(rows);
  const StepLimitCounts rest = step_limit_counts(table, LimitState::rest),
                        start = step_limit_counts(table, LimitState::start);
  const auto limits = [](size_t count, const char* lies, const char* lie) {
    return fmt::format("{} {}", count, count == 1 ? lies : lie);
  };
  std::vector<Finding> out;
  if (rest.agreeing > 0)
    out.push_back({.rule = "step-limits",
                   .value = 100 * rest.within,
                   .words = {{"limits", limits(rest.agreeing, "measured largest stable step lies",
                                               "measured largest stable steps lie")},
                             {"scenes", listed(rest.scenes)}}});
  if (rest.coarse > 0)
    out.push_back({.rule = "step-limits-coarse",
                   .value = 100 * rest.widest,
                   .words = {{"limits", limits(rest.coarse, "lies", "lie")}}});
  if (rest.apart > 0)
    out.push_back(
        {.rule = "step-limits-apart",
         .method = rest.method,
         .value = static_cast<double>(rest.apart),
         .words = {
             {"limits", limits(rest.apart, "limit lies", "limits lie")}, {"where", rest.where}, {"how", rest.how}}});
  if (const size_t all = start.agreeing + start.coarse + start.apart; all > 0)
    out.push_back({.rule = "step-limits-at-start",
                   .value = static_cast<double>(start.apart),
                   .words = {{"all", counted(all, "limit")}}});
  return out;
}

namespace {

/// Limits of scenes without rest, held against the truth on both sides. Where it does not confirm all, the one that is
/// furthest off though it is called stable is named, or the one that is nearest though it is called failed.
void limits_by_truth(const TableSet& rows, std::vector<Finding>& out) {
  std::map<std::string, std::vector<LimitRow>> by_scene;
  for (LimitRow& row : rows_of<LimitRow>(rows))
    if (row.error_below && row.error_above && *row.motion > 0) by_scene[row.scene].push_back(std::move(row));
  const auto below = [](const LimitRow& row) { return *row.error_below / *row.motion; };
  const auto above = [](const LimitRow& row) { return *row.error_above / *row.motion; };
  for (const auto& [scene, limits] : by_scene) {
    const LimitRow &off = *std::ranges::max_element(limits, {}, below),
                   &near = *std::ranges::min_element(limits, {}, above);
    const auto confirmed = std::ranges::count_if(limits, confirmed_by_truth);
    Finding f{.rule = "limits-by-truth", .scene = scene, .value = static_cast<double>(confirmed)};
    const auto exception = [&](const LimitRow& row, const char* called, double step, double error) {
      f.method = row.method;
      return fmt::format("{}, {} at {}, is {} of the motion off", name_in_sentence(row.method), called, step_text(step),
                         percent(error, 1));
    };
    if (confirmed == std::ssize(limits))
      f.words["how"] = fmt::format("below, errors are at most {} of the motion, above at least {}",
                                   percent(below(off), 1), percent(above(near), 1));
    else if (below(off) > useless_from)
      f.words["how"] = exception(off, "stable", *off.step_below, below(off));
    else
      f.words["how"] = exception(near, "failed", *near.step_above, above(near));
    f.words["all"] = counted(limits.size(), "limit");
    out.push_back(f);
  }
}

/// Methods that fail at every step, as theory says.
void without_stable_step(const TableSet& rows, std::vector<Finding>& out) {
  std::map<std::string, std::vector<std::string>> scenes_of;  // by method
  for (const LimitRow& row : rows_of<LimitRow>(rows))
    if (row.state == LimitState::rest && row.prediction == PredictionKind::no_step &&
        row.measurement == MeasuredLimit::no_step)
      scenes_of[row.method].push_back(row.scene);
  for (const auto& [method, scenes] : scenes_of)
    out.push_back({.rule = "no-stable-step",
                   .method = method,
                   .value = static_cast<double>(scenes.size()),
                   .words = {{"where", listed(scenes)}}});
}

/// The rates at which vibrations grow.
void growth(const TableSet& rows, std::vector<Finding>& out) {
  Finding f{.rule = "growth", .value = -1};
  for (const GrowthRow& row : rows_of<GrowthRow>(rows))
    // growth near a limit is measured elsewhere
    if (const double off = 100 * std::abs(row.deviation); !row.share_of_limit && off > f.value)
      f.value = off, f.method = row.method, f.words = {{"where", row.scene}};
  if (f.value >= 0) out.push_back(f);
}

}  // namespace

std::vector<Finding> stability_findings(const TableSet& rows) {
  std::vector<Finding> out = limit_findings(rows);
  limits_by_truth(rows, out);
  without_stable_step(rows, out);
  growth(rows, out);
  return out;
}

}  // namespace crosscheck
