// What a finding rests on: rows of the tables, with fingerprints that tell whether they are still the same.
#pragma once

#include "report/findings.h"

namespace crosscheck {

struct Grounds {
  std::string table;
  std::vector<long> rows;   // counted from 1 below the header
  std::string fingerprint;  // 16 hexadecimal digits (FNV-1a), of these rows as the CSV file has them
};

/// Rows of the tables of the finding's rule: those of its scene, or all where it speaks of all scenes.
std::vector<Grounds> grounds_of(const Finding& finding, const Rows& result);
/// Of a whole table.
Grounds grounds_of(const Table& table);

/// All findings of a report: those on all scenes together, then those of each scene.
struct AllFindings {
  std::vector<SceneFacts> facts;  // of each scene
  std::vector<Finding> overall;
  std::vector<std::vector<Finding>> of_scenes;
};
AllFindings all_findings(const std::vector<Scene>& scenes, const Rows& result);

}  // namespace crosscheck
