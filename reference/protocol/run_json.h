// run.json of the engine protocol (PROTOCOL.md): a program's report on its run.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "mysim/run/run.h"

namespace crosscheck {

/// JSON text with the outcome's verdict, cost, laws and read-back.
std::string run_json(const Outcome& outcome);

/// Reads the existing keys into the outcome, and leaves the rest unchanged. A `readback` requires masses, pins, links
/// and precision. Impossible numbers are rejected: counts beyond 2^53, steps and times beyond the run's duration (s),
/// more CPU time than thirty years. Throws InputError: "FILE: PLACE: expected ...".
void read_run_json(const std::filesystem::path& file, Outcome& outcome,
                   double duration = std::numeric_limits<double>::infinity());

}  // namespace crosscheck
