// Turns an engine linked with crosscheck's libraries into a program that speaks the engine protocol.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// The program's main function: reads the task named by its arguments, runs the engine that `engine_of` selects by the
/// options, and writes the output that PROTOCOL.md requires. Exit status: 3 for Unsupported, 2 for InputError, 1 for
/// other exceptions; the message goes to standard error.
int run_as_program(int argc, char** argv, const std::function<Engine(const std::vector<std::string>&)>& engine_of);

}  // namespace crosscheck
