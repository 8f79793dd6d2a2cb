#include <algorithm>
#include <map>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/cost.h"
#include "reference/engines/engines.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

template <class Row>
bool is_asked(const Row& row) {
  return std::abs(row.part_of_motion / 0.01 - 1) < 1e-9 && row.measure == Measure::error;
}

/// Range of a ratio, and where it is largest.
struct Span {
  double low = 0, high = 0;
  std::string where;
  size_t count = 0;
  void take(double value, const std::string& at) {
    low = count == 0 ? value : std::min(low, value);
    if (count == 0 || value > high) high = value, where = at;
    ++count;
  }
};

Finding finding_of(const std::string& rule, const Span& span) {
  return {.rule = rule, .value = span.high, .low = span.low, .high = span.high, .words = {{"where", span.where}}};
}

}  // namespace

/// CPU times that other engines need for the same accuracy, and engines that do not reach it.
Findings speed_findings(const Facts& facts) {
  const TableSet& rows = facts.rows;
  std::map<std::string, Span> times;
  std::map<std::string, std::vector<std::string>> within, without;  // scenes, by engine
  for (const EngineSpeedRow& row : rows_of<EngineSpeedRow>(rows)) {
    if (!is_asked(row) || !is_another_engine(row.method)) continue;
    within[row.engine].push_back(row.scene);
    if (row.times_mysim) times[row.engine].take(*row.times_mysim, row.scene);
  }
  // programs may reach the accuracy without reporting times
  for (const SpeedAccuracyRow& run : rows_of<SpeedAccuracyRow>(rows))
    if (run.verdict == Verdict::ok && run.error && *run.error <= 0.01 * run.motion)
      within[engine_of(run.method)].push_back(run.scene);
  std::vector<std::string> asked;  // scenes with a comparison
  for (const auto& row : rows_of<CheapestRow<Cost::cpu>>(rows))
    if (is_asked(row) && !row.method.value_or("").empty()) asked.push_back(row.scene);
  for (const SpeedAccuracyRow& run : rows_of<SpeedAccuracyRow>(rows)) {
    const std::string engine = engine_of(run.method);
    if (!is_another_engine(run.method) || run.verdict == Verdict::unsupported || run.verdict == Verdict::crash ||
        run.verdict == Verdict::timeout || !std::ranges::count(asked, run.scene) ||
        std::ranges::count(within[engine], run.scene))
      continue;
    add_once(without[engine], run.scene);
  }
  Findings out;
  for (const auto& [engine, span] : times) {
    Finding f = finding_of("engine-times", span);
    f.method = engine, f.other = std::string(subject().name);
    const auto kept = kept_engine_of(engine);
    f.words["built"] = kept && !kept->is_native() ? kept->built : "";
    out.push_back(std::move(f));
  }
  for (const auto& [engine, scenes] : without)
    out.push_back({.rule = "engine-without-run",
                   .method = engine,
                   .value = double(scenes.size()),
                   .words = {{"where", listed(scenes)}}});
  return out;
}

/// A peer's CPU time relative to mysim's for the same rule, over the sizes of a cloth: with mysim's kernels for any
/// spring graph, and with its fused step.
Findings cost_findings(const Facts& facts) {
  std::map<long, std::map<std::string, double>> per_side;  // s per step
  for (const SizeCostRow& row : rows_of<SizeCostRow>(facts.rows)) per_side[row.side][row.method] = row.cpu;
  Findings out;
  for (const MethodFamily* peer : default_peers()) {
    const Method* standing = builtin_method(peer->representative);
    if (!standing || rule_of(*standing) != rule_of(*builtin_method(ours))) continue;
    const std::string its(peer->representative);
    for (const auto& [rule, method] : {std::pair{"size-cost.any", ours + "+plain"}, {"size-cost.grid", ours}}) {
      Span span;
      for (auto& [side, times] : per_side)
        if (times[method] > 0 && times[its] > 0) span.take(times[its] / times[method], fmt::format("{0} x {0}", side));
      if (span.count == 0) continue;
      Finding f = finding_of(rule, span);
      f.method = method, f.other = std::string(peer->name);
      f.words["build"] = peer->build == Build::debian ? "Debian's build" : std::string(peer->build_text);
      out.push_back(std::move(f));
    }
  }
  return out;
}

}  // namespace crosscheck
