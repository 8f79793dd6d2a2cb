// An engine linked with crosscheck's libraries, as a program of the engine protocol.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// The main function of such a program: reads the task named by its arguments, runs the engine, and writes the output
/// that PROTOCOL.md requires. `engine_of` selects the engine by the options. Exit status: 3 if the engine throws
/// Unsupported, 2 for InputError, 1 for any other exception; the message goes to standard error.
int run_as_program(int argc, char** argv, const std::function<Engine(const std::vector<std::string>&)>& engine_of);

}  // namespace crosscheck
