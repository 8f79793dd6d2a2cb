// What a report says otherwise than an earlier one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/grounds.h"

namespace crosscheck {

struct Change {
  std::string scene;        // or empty: of all
  std::string before, now;  // sentences; empty where there was none, or is none any more
  bool timed = false;       // rests on timings, which are never the same twice
};

/// Findings of OLD/report.json beside these, those of one rule and scene in their order; what stayed is left out.
/// Throws InputError where OLD holds no finished report.
std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now);

}  // namespace crosscheck
