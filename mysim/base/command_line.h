// Error messages and tables of command lines, for the programs that use CLI11; mysim itself does not.
#pragma once

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "mysim/base/text.h"

namespace crosscheck {

/// CLI11's errors in words for people: unknown options come first, since they
/// are why others seem to be missing.
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
        return fmt::format("{}one word too many: '{}' ({} {}--help shows what is expected)", place, word.substr(0, 60),
                           program, help);
      const std::vector<std::string> known = names_of(command);
      if (std::find(known.begin(), known.end(), option) != known.end())
        return fmt::format("{} stands before the command; expected {} {} ... {}", option, program, command->get_name(),
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

/// All that --help says, one thing a line, its parts separated by tabs: "command NAME WHAT", and behind each command
/// "word NAME WHAT" for what has a place and "option NAMES VALUE WHAT", NAMES separated by commas and VALUE empty where
/// none is taken. What --help hides is left out. The manual and the shell's completions are made of it.
inline std::string command_table(const CLI::App& app) {
  std::string table;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    table += fmt::format("command\t{}\t{}\n", command->get_name(), command->get_description());
    for (const CLI::Option* option :
         command->get_options([](const CLI::Option* one) { return !one->get_group().empty(); })) {
      if (option->get_positional()) {
        table += fmt::format("word\t{}\t{}\n", option->get_name(true), option->get_description());
        continue;
      }
      std::vector<std::string> names;
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      const bool takes_value = option->get_items_expected_max() > 0;
      table += fmt::format("option\t{}\t{}\t{}\n", fmt::join(names, ","), takes_value ? option->get_type_name() : "",
                           option->get_description());
    }
  }
  return table;
}

}  // namespace crosscheck
