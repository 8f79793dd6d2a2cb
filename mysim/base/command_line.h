// Error messages and option tables of command lines, for programs that use CLI11 (mysim itself does not).
#pragma once

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mysim/base/json.h"
#include "mysim/base/text.h"

namespace crosscheck {

/// Readable form of CLI11's errors. Unknown options are reported first, because they often cause the other errors.
inline std::string usage_error(const std::string& program, const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  const bool top = command == &app;
  const std::string place = top ? "" : command->get_name() + ": ", help = top ? "" : command->get_name() + " ";
  const auto names_of = [](const CLI::App* of) {
    std::vector<std::string> names;
    for (const CLI::Option* option : of->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
  };
  for (const CLI::App* of : {command, &app})
    for (const std::string& word : of->remaining()) {
      const std::string option = word.substr(0, word.find('='));
      if (!option.starts_with("-") || option == "-" || option == "--")
        return fmt::format("{}unexpected argument '{}' ({} {}--help shows what is expected)", place, word.substr(0, 60),
                           program, help);
      const std::vector<std::string> known = names_of(command);
      if (std::find(known.begin(), known.end(), option) != known.end())
        return fmt::format("{} must follow the command; expected {} {} ... {}", option, program, command->get_name(),
                           option);
      const bool out = option == "-o" || option == "--out";
      const auto other = std::find(known.begin(), known.end(), out ? option == "-o" ? "--out" : "-o" : "");
      const std::string proposal =
          other != known.end() ? fmt::format("; did you mean '{}'?", *other) : did_you_mean(option, known);
      return fmt::format("{}unknown option '{}'{} ({} {}--help shows all)", place, option.substr(0, 60), proposal,
                         program, help);
    }
  return fmt::format("{}{} ({} {}--help shows what is expected)", place, error.what(), program, help);
}

/// The content of --help as JSON, from which the manual and the shell completions are generated. Each command has
/// `name`, `what`, `words` (positional arguments) and `options`. A word has `name` and `what`. An option has `names`,
/// `title` (the names joined), `value` (empty for flags) and `what`. Omits hidden entries and --help itself.
inline std::string command_table(const CLI::App& app) {
  Json table = Json::array();
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    Json words = Json::array(), options = Json::array();
    for (const CLI::Option* option : command->get_options(
             [&](const CLI::Option* one) { return !one->get_group().empty() && one != command->get_help_ptr(); })) {
      if (option->get_positional()) {
        words.push_back({{"name", option->get_name(true)}, {"what", option->get_description()}});
        continue;
      }
      std::vector<std::string> names;
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      options.push_back({{"names", names},
                         {"title", fmt::format("{}", fmt::join(names, ", "))},
                         {"value", option->get_items_expected_max() > 0 ? option->get_type_name() : ""},
                         {"what", option->get_description()}});
    }
    table.push_back({{"name", command->get_name()},
                     {"what", command->get_description()},
                     {"words", std::move(words)},
                     {"options", std::move(options)}});
  }
  return dump(table);
}

}  // namespace crosscheck
