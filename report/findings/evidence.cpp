#include "report/findings/evidence.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "experiments/tables/table.h"
#include "mysim/base/hash.h"

namespace crosscheck {

std::string figure_of(std::string_view name, const std::string& scene, const std::vector<std::string>& figures) {
  std::string wanted(finding_rule(name).figure);
  if (wanted.empty()) return "";
  if (const size_t at = wanted.find("{}"); at != std::string::npos) wanted.replace(at, 2, scene);
  const bool any = wanted.starts_with('*');
  std::string found;
  for (const std::string& figure : figures)
    if (any ? figure.ends_with(wanted.substr(1)) : figure == wanted) found = figure;
  return found;
}

namespace {

template <class Keep>
Evidence rows_of(const Table& table, Keep keep) {
  Evidence evidence{table.name, {}, {}};
  std::string text;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (keep(i)) evidence.rows.push_back(static_cast<long>(i) + 1), text += csv_row(table.rows[i]) + "\n";
  evidence.fingerprint = fmt::format("{:016x}", Fnv1a::of(text));
  return evidence;
}

}  // namespace

Json json_of(const Evidence& e) { return {{"table", e.table}, {"rows", e.rows}, {"fingerprint", e.fingerprint}}; }

Evidence evidence_of(const Table& table) {
  return rows_of(table, [](size_t) { return true; });
}

std::vector<Evidence> evidence_of(const Finding& finding, const TableSet& result) {
  std::vector<Evidence> all;
  for (const std::string_view name : finding_rule(finding.rule).tables)
    if (const Table* table = result.table(std::string(name))) {
      const bool by_scene = !finding.scene.empty() && std::ranges::count(table->columns, "scene", &Column::name) > 0;
      all.push_back(
          rows_of(*table, [&](size_t i) { return !by_scene || text_or_none(*table, i, "scene") == finding.scene; }));
    }
  return all;
}

AllFindings all_findings(const std::vector<Scene>& scenes, const TableSet& result) {
  AllFindings all;
  for (const Scene& scene : scenes) all.facts.push_back(scene_data(scene.name, result));
  Facts facts(result, scenes, all.facts);
  all.overall = found_by_rules(facts, false);
  for (size_t i = 0; i < scenes.size(); ++i) {
    facts.scene = &scenes[i], facts.of = &all.facts[i];
    all.of_scenes.push_back(found_by_rules(facts, true));
  }
  return all;
}

std::vector<const Finding*> AllFindings::each() const {
  std::vector<const Finding*> all;
  for (const Finding& f : overall) all.push_back(&f);
  for (const auto& of_scene : of_scenes)
    for (const Finding& f : of_scene) all.push_back(&f);
  return all;
}

}  // namespace crosscheck
