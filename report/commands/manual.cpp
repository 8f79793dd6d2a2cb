// Fills report/install/crosscheck.1 (manual page) and .bash (completions) with the commands' own descriptions.

#include "mysim/base/command_line.h"
#include "report/base/assets.h"
#include "report/commands/command_line.h"
#include "report/page/template.h"

namespace crosscheck {
namespace {

/// Kinds of names (as in `list KIND`) that complete a word; empty if the word stands for no name.
std::string kinds_of(const std::string& command, const std::string& word) {
  if (word == "SCENE" || word == "scenes") return "scenes";
  if (word == "METHOD") return "methods scenes";
  if (word == "ASSIGNMENT" || command == "assignment") return "assignments";
  if (command == "experiment") return "experiments scenes";
  if (command == "figures") return "experiments";
  return "";
}

/// All commands in the format of command_table(), including the grader's, which are registered by name only.
Json all_commands(const CLI::App& app) {
  Json commands = Json::parse(command_table(app));
  const Json graders = Json::parse(grader_table());
  for (Json& command : commands) {
    for (const Json& other : graders)
      if (command["name"] == other["name"] && command["words"].empty()) command = other;
    std::string kinds;
    for (const Json& word : command["words"]) kinds += kinds_of(command["name"], word["name"]) + " ";
    command["kinds"] = kinds;
  }
  return commands;
}

void escape_for_troff(Json& data) {
  if (!data.is_string()) {
    for (Json& item : data) escape_for_troff(item);
    return;
  }
  std::string text;
  for (const char c : data.get<std::string>()) text += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  data = (text.starts_with(".") || text.starts_with("'") ? "\\&" : "") + text;
}

int manual_command(const CLI::App& app, const std::string& form) {
  if (form != "man" && form != "bash") throw InputError(fmt::format("manual {}: expected man or bash", form));
  Json data{
      {"version", program_and_version()}, {"description", app.get_description()}, {"commands", all_commands(app)}};
  if (form == "man") escape_for_troff(data);
  const std::string name = form == "man" ? "install/crosscheck.1" : "install/crosscheck.bash";
  fmt::print("{}", Template(name, asset(name)).filled(data));
  return 0;
}

}  // namespace

void add_manual(CLI::App& app, Invocation& call) {
  const auto form = std::make_shared<std::string>();
  auto* manual = app.add_subcommand("manual", "prints the manual page (man) or bash's completions (bash)")->group("");
  manual->add_option("FORM", *form, "man or bash")->required();
  manual->callback([&app, &call, form] { call.status = manual_command(app, *form); });
}

}  // namespace crosscheck
