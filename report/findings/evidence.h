// The evidence of a finding: table rows, with fingerprints that detect changes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/findings/findings.h"

namespace crosscheck {

/// The figure that shows a finding (the last, if several do); empty if none does.
std::string figure_of(std::string_view rule, const std::string& scene, const std::vector<std::string>& figures);

struct Evidence {
  std::string table;
  std::vector<long> rows;   // counted from 1 below the header
  std::string fingerprint;  // 16 hexadecimal digits (FNV-1a) over these rows as written in the CSV file
};

/// Format of report.json.
Json json_of(const Evidence& evidence);

/// Rows of the tables of the finding's rule: those of its scene, or all rows if it is about all scenes.
std::vector<Evidence> evidence_of(const Finding& finding, const TableSet& result);
/// The evidence of a whole table.
Evidence evidence_of(const Table& table);

/// All findings of a report: first those about all scenes, then those of each scene.
struct AllFindings {
  std::vector<SceneData> facts;  // one per scene
  Findings overall;
  std::vector<Findings> of_scenes;
  /// All findings, in this order.
  std::vector<const Finding*> each() const;
};
AllFindings all_findings(const std::vector<Scene>& scenes, const TableSet& result);

}  // namespace crosscheck
