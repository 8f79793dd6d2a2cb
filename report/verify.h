// Whether a report's sentences still follow from its data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

struct Verification {
  int findings = 0;                     // in report.json
  int rows = 0;                         // of all tables
  std::vector<std::string> mismatches;  // for people, one a line
};

/// Reads DIR/report.json, DIR/data/*.csv and DIR/data/scenes/*.toml, computes every finding anew from these tables, and
/// holds it against what report.json says: sentence, tier, and the fingerprints of the rows that it rests on. A row
/// that no finding rests on is held against its table's fingerprint. Throws InputError where a file is missing or
/// cannot be read.
Verification verify_report(const std::filesystem::path& folder);

}  // namespace crosscheck
