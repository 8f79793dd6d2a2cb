#include <algorithm>
#include <cmath>
#include <map>

#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {

Findings limit_findings(const Facts& facts) {
  const std::vector<LimitRow> table = rows_of<LimitRow>(facts.rows);
  const auto count = [](size_t n) { return std::to_string(n); };
  const StepLimitCounts rest = step_limit_counts(table, LimitState::rest),
                        start = step_limit_counts(table, LimitState::start);
  Findings out;
  if (rest.agreeing > 0)
    out.push_back({.rule = "step-limits",
                   .value = 100 * rest.deviation,
                   .words = {{"confirmed", count(rest.agreeing + rest.coarse)},
                             {"all", count(rest.all())},
                             {"bracket", percent(rest.widest, 1)},
                             {"scenes", listed(rest.scenes)}}});
  if (rest.apart > 0)
    out.push_back({.rule = "step-limits-apart",
                   .method = rest.method,
                   .value = double(rest.apart),
                   .words = {{"all", count(rest.all())}, {"where", rest.where}, {"how", rest.how}}});
  if (start.all() > 0)
    out.push_back(
        {.rule = "step-limits-apart.start", .value = double(start.apart), .words = {{"all", count(start.all())}}});
  return out;
}

namespace {

/// Tests limits of scenes without a state of rest: compares runs below and above each limit with the truth. If the
/// truth does not confirm all limits, names the worst run that was called stable, or the best run that was called
/// failed.
void limits_by_truth(const TableSet& rows, Findings& out) {
  std::map<std::string, std::vector<LimitRow>> by_scene;
  for (LimitRow& row : rows_of<LimitRow>(rows))
    if (row.error_below && row.error_above && *row.motion > 0) by_scene[row.scene].push_back(std::move(row));
  const auto below = [](const LimitRow& row) { return *row.error_below / *row.motion; };
  const auto above = [](const LimitRow& row) { return *row.error_above / *row.motion; };
  for (const auto& [scene, limits] : by_scene) {
    const LimitRow &off = *std::ranges::max_element(limits, {}, below),
                   &near = *std::ranges::min_element(limits, {}, above);
    const auto confirmed = std::ranges::count_if(limits, confirmed_by_truth);
    const bool all = confirmed == std::ssize(limits), stable = below(off) > useless_from;
    const LimitRow& exception = stable ? off : near;
    out.push_back({.rule = "limits-by-truth",
                   .scene = scene,
                   .method = all ? "" : exception.method,
                   .value = double(confirmed),
                   .words = {{"all", std::to_string(limits.size())},
                             {"below", all ? percent(below(off), 1) : ""},
                             {"above", percent(above(near), 1)},
                             {"name", all ? "" : name_in_sentence(exception.method)},
                             {"step", step_text(stable ? *exception.step_below : *exception.step_above)},
                             {"error", percent(stable ? below(exception) : above(exception), 1)}}});
  }
}

void without_stable_step(const TableSet& rows, Findings& out) {
  std::map<std::string, std::vector<std::string>> scenes_of;  // by method
  for (const LimitRow& row : rows_of<LimitRow>(rows))
    if (row.state == LimitState::rest && row.prediction == PredictionKind::no_step &&
        row.measurement == MeasuredLimit::no_step)
      scenes_of[row.method].push_back(row.scene);
  for (const auto& [method, scenes] : scenes_of)
    out.push_back({.rule = "no-stable-step",
                   .method = method,
                   .value = double(scenes.size()),
                   .words = {{"where", listed(scenes)}}});
}

void growth(const TableSet& rows, Findings& out) {
  Finding f{.rule = "growth", .value = -1};
  for (const GrowthRow& row : rows_of<GrowthRow>(rows))
    // omit rows near a stability limit
    if (const double off = 100 * std::abs(row.deviation); !row.share_of_limit && off > f.value)
      f.value = off, f.method = row.method, f.words = {{"where", row.scene}};
  if (f.value >= 0) out.push_back(f);
}

}  // namespace

Findings stability_findings(const Facts& facts) {
  Findings out;
  for (const auto part : {limits_by_truth, without_stable_step, growth}) part(facts.rows, out);
  return out;
}

}  // namespace crosscheck
