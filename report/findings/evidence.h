// The evidence of a finding: rows of the tables, with fingerprints that show whether they are still the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/findings/findings.h"

namespace crosscheck {

/// The one of these figures that shows a finding, the last of several; empty where none does.
std::string figure_of(std::string_view rule, const std::string& scene, const std::vector<std::string>& figures);

struct Evidence {
  std::string table;
  std::vector<long> rows;   // counted from 1 below the header
  std::string fingerprint;  // 16 hexadecimal digits (FNV-1a), of these rows as the CSV file has them
};

/// As in report.json.
Json json_of(const Evidence& evidence);

/// Rows of the tables of the finding's rule: those of its scene, or all where it speaks of all scenes.
std::vector<Evidence> evidence_of(const Finding& finding, const TableSet& result);
/// The evidence of a whole table.
Evidence evidence_of(const Table& table);

/// All findings of a report: those on all scenes together, then those of each scene.
struct AllFindings {
  std::vector<SceneData> facts;  // of each scene
  Findings overall;
  std::vector<Findings> of_scenes;
  /// Of all of them, in this order.
  std::vector<const Finding*> each() const;
};
AllFindings all_findings(const std::vector<Scene>& scenes, const TableSet& result);

}  // namespace crosscheck
