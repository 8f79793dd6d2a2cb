// The common part of all programs' command lines.
#include "report/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mysim/base/command_line.h"
#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/truth/cache.h"

namespace crosscheck {
namespace {

CLI::Validator number(bool zero_allowed) {
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

void require_known_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  if (word == "test") throw InputError("test: the suite is built and run in a source tree: ./crosscheck test there");
  throw InputError(unknown_name("command", word, known, "crosscheck --help"));
}

}  // namespace

CLI::Validator above_zero() { return number(false); }
CLI::Validator not_below_zero() { return number(true); }

void add_quick_and_full(CLI::App& command, bool& full) {
  auto* quick = command.add_flag("--quick")->description("few scenes and measurements (default)");
  command.add_flag("--full", full, "more scenes, more measurements and finer pictures")->excludes(quick);
}

std::string program_and_version() { return "crosscheck " CROSSCHECK_VERSION; }

std::string version_text() {
  const std::string id = build_id();
  return fmt::format("{}{}", program_and_version(), id.empty() ? "" : " (build " + id.substr(0, 12) + ")");
}

int run_command_line(const std::string& description, const std::string& version, std::span<const AddCommand> commands,
                     int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  words[0] = "crosscheck";
  Invocation call{shell_join(words)};
  CLI::App app{description};
  app.require_subcommand(1);
  if (!version.empty()) app.set_version_flag("--version", version, "the version of this program");
  for (const AddCommand add : commands) add(app, call);
  if (argc > 1 && argv[1][0] != '-') require_known_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    throw InputError(usage_error("crosscheck", app, error));
  }
  return call.status;
}

}  // namespace crosscheck
