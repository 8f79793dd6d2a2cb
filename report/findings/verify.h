#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/findings/evidence.h"

namespace crosscheck {

/// Version of the format of report folders (CONTRACT.md).
inline constexpr int report_format = 2;

struct Verification {
  int findings = 0;                     // in report.json
  int rows = 0;                         // in all tables
  std::vector<std::string> mismatches;  // messages; those about tables and scenes come first
  size_t of_data = 0;                   // number of messages about tables and scenes
};

/// Reads DIR/report.json, DIR/data/*.csv and DIR/data/scenes/*.toml, recomputes every finding, and compares sentence,
/// tier, value, interval, and fingerprints of rows with report.json. Rows without a finding are covered by the
/// fingerprint of their table. Throws InputError if a file is missing or unreadable, or has another format.
Verification verify_report(const std::filesystem::path& folder);

struct Change {
  std::string scene;        // empty: all scenes
  std::string before, now;  // sentences; empty for new or removed findings
  bool timed = false;       // depends on timings, which differ in every run
};

/// Compares findings with those of OLD/report.json. Pairs findings of the same rule, scene and method in their order,
/// and omits unchanged findings. Throws InputError if OLD has no finished report of this format.
std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now);

}  // namespace crosscheck
