// run.json of the engine protocol: what a program reports of its run, besides the trajectory. Its format is described
// in PROTOCOL.md.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "mysim/run/run.h"

namespace crosscheck {

/// The file's content: verdict, cost, laws and read-back of the outcome.
std::string run_json(const Outcome& outcome);

/// Reads what is there into the outcome and leaves the rest as it is. `readback` is taken whole or not at all: masses,
/// pins, links and precision belong to it. Numbers that no run can have (counts beyond 2^53, steps and times beyond the
/// run's duration, s, more CPU time than thirty years) are refused. Throws InputError: "FILE: PLACE: expected ...".
void read_run_json(const std::filesystem::path& file, Outcome& outcome,
                   double duration = std::numeric_limits<double>::infinity());

}  // namespace crosscheck
