#include "report/grounds.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/cells.h"
#include "mysim/fnv.h"
#include "report/choice.h"
#include "report/finding_rules.h"

namespace crosscheck {
namespace {

bool has_column(const Table& table, const char* name) {
  return std::any_of(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == name; });
}

template <class Keep>
Grounds rows_of(const Table& table, Keep keep) {
  Grounds grounds{table.name, {}, {}};
  std::string text;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (keep(i)) grounds.rows.push_back(static_cast<long>(i) + 1), text += csv_row(table.rows[i]) + "\n";
  grounds.fingerprint = fmt::format("{:016x}", Fnv1a::of(text));
  return grounds;
}

}  // namespace

Grounds grounds_of(const Table& table) {
  return rows_of(table, [](size_t) { return true; });
}

std::vector<Grounds> grounds_of(const Finding& finding, const Rows& result) {
  std::vector<Grounds> all;
  for (const std::string_view name : finding_rule(finding.rule).tables)
    if (const Table* table = result.table(std::string(name))) {
      const bool by_scene = !finding.scene.empty() && has_column(*table, "scene");
      all.push_back(
          rows_of(*table, [&](size_t i) { return !by_scene || text_or_none(*table, i, "scene") == finding.scene; }));
    }
  return all;
}

AllFindings all_findings(const std::vector<Scene>& scenes, const Rows& result) {
  AllFindings all;
  for (const Scene& scene : scenes) all.facts.push_back(facts_of(scene.name, result));
  all.overall = overall_findings(scenes, all.facts, result);
  for (size_t i = 0; i < scenes.size(); ++i) {
    all.of_scenes.push_back(findings_of(scenes[i], all.facts[i]));
    all.of_scenes.back().push_back(choice_finding(scenes[i], all.facts[i], result));
  }
  return all;
}

}  // namespace crosscheck
