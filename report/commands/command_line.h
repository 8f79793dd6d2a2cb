// The common part of all programs' command lines.
#pragma once

#include <span>
#include <string>

#include "report/commands/commands.h"

namespace CLI {
class Validator;
}

namespace crosscheck {

using AddCommand = void (*)(CLI::App&, Invocation&);

/// Reads the command line, runs its command, and returns the exit status. Throws
/// InputError that names the nearest word. `version`: what --version prints; empty: there is no such option.
int run_command_line(const std::string& description, const std::string& version, std::span<const AddCommand> commands,
                     int argc, char** argv);

/// The name of the program and its version, that of the build where it has one.
std::string version_text();
/// The two without the build.
std::string program_and_version();

/// Finite numbers and fractions: CLI11's own range checks let nan through and print 309 digits. Times may have a unit,
/// and reach the option in seconds. To be given to Option::transform().
CLI::Validator above_zero();
CLI::Validator time_above_zero();
CLI::Validator time_not_below_zero();

/// --quick and --full, which exclude each other.
void add_quick_and_full(CLI::App& command, bool& full);

}  // namespace crosscheck
