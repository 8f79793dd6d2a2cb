// What the command lines of all our programs have in common, and the commands that two of them have.
#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "mysim/base/command_line.h"
#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/truth/cache.h"
#include "report/commands/commands.h"

namespace crosscheck {

/// The command line as a person would type it.
inline std::string command_line(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  words[0] = "crosscheck";
  return shell_join(words);
}

/// CLI11's own range checks let nan through and print 309 digits.
inline CLI::Validator number(bool zero_allowed) {
  return CLI::Validator(
      [zero_allowed](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool good =
            end != text.c_str() && *end == '\0' && std::isfinite(value) && (value > 0 || (zero_allowed && value == 0));
        return good ? std::string()
                    : fmt::format("expected a finite number {} zero, got '{}'", zero_allowed ? "not below" : "above",
                                  text);
      },
      "");
}

/// The name of the program and its version, that of the build where it has one.
inline std::string version() {
  const std::string id = build_id();
  return fmt::format("crosscheck " CROSSCHECK_VERSION "{}", id.empty() ? "" : " (build " + id.substr(0, 12) + ")");
}

/// `validate` and `run`; `line` is the command line, `status` takes the exit status.
inline void add_single_run(CLI::App& app, const std::string& line, int& status) {
  const CLI::Validator above_zero = number(false);
  struct Options {
    std::vector<std::string> validated;
    bool json = false;
    RunOptions run;
  };
  const auto options = std::make_shared<Options>();
  auto* validate = app.add_subcommand("validate", "what a scene is, and whether its file is good; runs nothing");
  validate->add_option("SCENE", options->validated, "shipped scenes or TOML files")->required();
  validate->add_flag("--json", options->json, "for programs");
  validate->callback([options, &status] { status = validate_command(options->validated, options->json); });

  auto* run = app.add_subcommand("run", "one run: trajectory, energies, verdict");
  run->add_option("SCENE", options->run.scene, "a shipped scene or a TOML file")->required();
  run->add_option("--method", options->run.method, "default: the scene's own");
  run->add_option("--step", options->run.step, "s, of fixed-step methods")->check(above_zero);
  run->add_option("--tol", options->run.tolerance, "relative, of adaptive methods")->check(above_zero);
  run->add_option("--duration", options->run.duration, "s")->check(above_zero);
  run->add_option("--out", options->run.out, "folder (out/run)");
  run->callback([options, line, &status] { options->run.command_line = line, status = run_command(options->run); });
}

/// Reads the command line, runs what it asks for, and returns `status`. Throws InputError that names the nearest word.
inline int parse(CLI::App& app, int argc, char** argv, const int& status) {
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
      known.push_back(command->get_name());
    if (std::find(known.begin(), known.end(), argv[1]) == known.end())
      throw InputError(fmt::format("unknown command '{}'; expected one of: {}{}", argv[1], fmt::join(known, ", "),
                                   did_you_mean(argv[1], known)));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    throw InputError(usage_error("crosscheck", app, error));
  }
  return status;
}

}  // namespace crosscheck
