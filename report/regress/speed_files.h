// The speed part of the files of a regression run.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiments/regress/speed_run.h"
#include "experiments/table.h"

namespace crosscheck {

/// speed-cost: every speed that was measured.
Table table_of(const Speeds& speeds);

/// {"passed": ..., "compared": [...], "notes": [...], "failures": [...]}; an entry for every speed that was measured.
nlohmann::ordered_json json_of(const Speeds& speeds);

/// JUnit: a case for each speed that was compared.
struct SpeedCases {
  std::string body;
  size_t cases = 0, failures = 0, errors = 0;
};
SpeedCases cases_of(const Speeds& speeds);

}  // namespace crosscheck
