// Checks a report against its own data, and against an earlier report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/findings/evidence.h"

namespace crosscheck {

/// Version of the contract between `report` and the readers of its folders (CONTRACT.md).
inline constexpr int report_format = 2;

// Verification that a report's sentences follow from its data.

struct Verification {
  int findings = 0;                     // number of findings in report.json
  int rows = 0;                         // number of rows in all tables
  std::vector<std::string> mismatches;  // messages, one per line; those about tables and scenes first
  size_t of_data = 0;                   // number of the messages about tables and scenes
};

/// Reads DIR/report.json, DIR/data/*.csv and DIR/data/scenes/*.toml, recomputes every finding from these tables, and
/// compares it with report.json: sentence, tier, value, interval, and fingerprints of its rows. Rows without a finding
/// are covered by the fingerprint of their table. Throws InputError if a file is missing or unreadable, or if the
/// report has another format.
Verification verify_report(const std::filesystem::path& folder);

// Changes of a report since an earlier one.

struct Change {
  std::string scene;        // empty: all scenes
  std::string before, now;  // sentences; empty for a new or a removed finding
  bool timed = false;       // rests on timings, which differ in every run
};

/// Compares the findings of OLD/report.json with these; findings of the same rule, scene and method are paired in
/// order. Unchanged findings are omitted. Throws InputError if OLD has no finished report of this format.
std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now);

}  // namespace crosscheck
