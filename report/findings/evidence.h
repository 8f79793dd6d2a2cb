// The evidence of a finding: table rows, with fingerprints that reveal changes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/findings/findings.h"

namespace crosscheck {

/// The last of the `figures` that shows a finding; empty if none does.
std::string figure_of(std::string_view rule, const std::string& scene, const std::vector<std::string>& figures);

struct Evidence {
  std::string table;
  std::vector<long> rows;   // counted from 1 below the header
  std::string fingerprint;  // 16 hexadecimal digits (FNV-1a) over these rows as in the CSV file
};

/// In the format of report.json.
Json json_of(const Evidence& evidence);

/// Rows of the tables of the finding's rule; only rows of the finding's scene, if it has one.
std::vector<Evidence> evidence_of(const Finding& finding, const TableSet& result);
Evidence evidence_of(const Table& table);

/// Findings about all scenes, followed by those of each scene.
struct AllFindings {
  std::vector<SceneData> facts;  // one per scene
  Findings overall;
  std::vector<Findings> of_scenes;
  std::vector<const Finding*> each() const;
};
AllFindings all_findings(const std::vector<Scene>& scenes, const TableSet& result);

}  // namespace crosscheck
