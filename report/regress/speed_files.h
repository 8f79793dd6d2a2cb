// The speed part of the files of a regression run.
#pragma once

#include "experiments/regress/speed_run.h"
#include "experiments/table.h"
#include "mysim/json.h"

namespace crosscheck {

/// speed-cost: every speed that was measured.
Table table_of(const Speeds& speeds);

/// Adds "speed" (an entry for every speed that was measured), "speed_notes" and "speed_failures" to the verdict.
void add_speeds(Json& verdict, const Speeds& speeds);

/// JUnit: a case for each speed that was compared.
struct SpeedCases {
  std::string body;
  size_t cases = 0, failures = 0, errors = 0;
};
SpeedCases cases_of(const Speeds& speeds);

}  // namespace crosscheck
