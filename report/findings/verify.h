// A report held against its own data, and against an earlier report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/findings/evidence.h"

namespace crosscheck {

/// The number of the contract between `report` and what reads its folders (CONTRACT.md).
inline constexpr int report_format = 2;

// Whether a report's sentences still follow from its data.

struct Verification {
  int findings = 0;                     // in report.json
  int rows = 0;                         // of all tables
  std::vector<std::string> mismatches;  // for people, one a line; those of tables and scenes first
  size_t of_data = 0;                   // so many of them are of tables and scenes
};

/// Reads DIR/report.json, DIR/data/*.csv and DIR/data/scenes/*.toml, computes every finding anew from these tables, and
/// holds it against what report.json says: sentence, tier, value and interval, and the fingerprints of the rows that
/// it rests on. A row
/// that no finding rests on is held against its table's fingerprint. Throws InputError where a file is missing or
/// cannot be read, or the report has another format.
Verification verify_report(const std::filesystem::path& folder);

// Changes of a report against an earlier one.

struct Change {
  std::string scene;        // or empty: of all
  std::string before, now;  // sentences; empty where there was none, or is none any more
  bool timed = false;       // rests on timings, which are never the same twice
};

/// Findings of OLD/report.json compared with these, those of one rule, scene and method in their order; what stayed is
/// left out. Throws InputError where OLD holds no finished report of this format.
std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now);

}  // namespace crosscheck
