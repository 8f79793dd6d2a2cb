// An engine that is linked with crosscheck's libraries as a program of the engine protocol.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// The main function of such a program: reads the task that its two arguments name, runs the engine, and writes what
/// PROTOCOL.md asks for. `engine_of` chooses the engine by the options. The status: 3 where the engine throws
/// Unsupported, 2 for InputError, 1 for what else is thrown, whose message goes to the standard error.
int run_as_program(int argc, char** argv, const std::function<Engine(const std::vector<std::string>&)>& engine_of);

}  // namespace crosscheck
