// The verdict of a regression run for people and programs: CSV, JSON, JUnit.
#pragma once

#include "experiments/regress/regress.h"

namespace crosscheck {

/// regress.csv (every quantity), regress.json (failures, counts, cause) and junit.xml (one case for each scene and
/// method) in the folder. `cause` is empty where it is not attributed.
void write_verdict(const Regressed& result, const std::string& cause, const Provenance& lines,
                   const std::filesystem::path& folder);

}  // namespace crosscheck
