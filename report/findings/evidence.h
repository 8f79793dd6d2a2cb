// The evidence of a finding: the formula of its rule, and rows of tables with fingerprints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/findings/findings.h"

namespace crosscheck {

// The derivation of each kind of finding from the tables: the formula behind its sentence, and where its rows stand.

struct FindingRule {
  std::string_view name;
  std::string_view formula;  // over columns of the tables, for a reader with the tables at hand
  std::vector<std::string_view> tables;
  std::string_view figure = {};  // that shows it: "{}" is the finding's scene, "*" any; empty: a table does
};

/// All of them; a new kind of finding is a row.
const std::vector<FindingRule>& finding_rules();

/// Throws std::logic_error with the name where there is none.
const FindingRule& finding_rule(std::string_view name);

/// The figure that shows a finding, of those that there are; of several the last. Empty where there is none.
std::string figure_of(std::string_view rule, const std::string& scene, const std::vector<std::string>& figures);

// The evidence of a finding: rows of the tables, with fingerprints that show whether they are still the same.

struct Evidence {
  std::string table;
  std::vector<long> rows;   // counted from 1 below the header
  std::string fingerprint;  // 16 hexadecimal digits (FNV-1a), of these rows as the CSV file has them
};

/// Rows of the tables of the finding's rule: those of its scene, or all where it speaks of all scenes.
std::vector<Evidence> evidence_of(const Finding& finding, const Rows& result);
/// Of a whole table.
Evidence evidence_of(const Table& table);

/// All findings of a report: those on all scenes together, then those of each scene.
struct AllFindings {
  std::vector<SceneData> facts;  // of each scene
  std::vector<Finding> overall;
  std::vector<std::vector<Finding>> of_scenes;
};
AllFindings all_findings(const std::vector<Scene>& scenes, const Rows& result);

}  // namespace crosscheck
