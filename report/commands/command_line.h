// Registers commands in the command line, and includes the headers that nearly all of them need.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/estimate.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/text.h"
#include "report/base/provenance.h"
#include "report/commands/commands.h"

namespace crosscheck {

std::string program_and_version();

/// Adds a command that `run` executes. A member `command_line` of the options receives the whole line.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& app, Invocation& call, const std::string& name,
                                           const std::string& what, int (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, what);
  command->callback([options, &call, run] {
    if constexpr (requires { options->command_line; }) options->command_line = call.line;
    call.status = run(*options);
  });
  return {*command, *options};
}

/// Splits a text into the number at its start, which may be a fraction such as 1/1000, and the rest without blanks.
/// Returns nullopt if the text does not start with a number.
std::optional<std::pair<double, std::string>> number_and_rest(const std::string& text);

/// Throws InputError if the -o argument is a folder or cannot be written.
void require_output_file(const std::filesystem::path& file);

/// Validators for Option::transform(). They accept finite numbers and fractions (CLI11's own range checks let nan
/// through and print 309 digits). Times may have a unit, and are passed on in seconds.
CLI::Validator above_zero();
CLI::Validator time_above_zero();
CLI::Validator time_not_below_zero();

void add_quick_and_full(CLI::App& command, bool& full);

}  // namespace crosscheck
