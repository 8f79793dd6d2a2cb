// The verdict of a regression run for people and programs: CSV, JSON, JUnit.
#pragma once

#include "experiments/regress/regress.h"
#include "experiments/regress/speed_run.h"

namespace crosscheck {

/// regress.csv (every quantity), regress.json (failures, counts, cause, speeds) and junit.xml (one case for each scene
/// and method, and one for its speed) in the folder; speed-cost.csv where speeds were measured. `cause` is empty where
/// it is not attributed.
void write_verdict(const Regressed& result, const Speeds& speeds, const std::string& cause, const Provenance& lines,
                   const std::filesystem::path& folder);

}  // namespace crosscheck
