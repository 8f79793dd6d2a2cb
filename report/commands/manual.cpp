// manual: the manual page and bash's completions, made of the commands' own descriptions.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "mysim/base/command_line.h"
#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "report/commands/command_line.h"
#include "report/commands/commands.h"

namespace crosscheck {
namespace {

struct CommandHelp {
  std::string name, what;
  struct Word {
    std::string name, what;
  };
  struct Option {
    std::vector<std::string> names;
    std::string value, what;  // the value is empty where there is none
  };
  std::vector<Word> words;
  std::vector<Option> options;
};

/// The commands of a table (mysim/base/command_line.h).
std::vector<CommandHelp> commands_in(const std::string& table) {
  std::vector<CommandHelp> commands;
  for (const std::string& line : split(table, '\n')) {
    const std::vector<std::string> parts = split(line, '\t');
    if (parts[0] == "command") commands.push_back({parts.at(1), parts.at(2), {}, {}});
    if (parts[0] == "word") commands.back().words.push_back({parts.at(1), parts.at(2)});
    if (parts[0] == "option") commands.back().options.push_back({split(parts.at(1), ','), parts.at(2), parts.at(3)});
  }
  return commands;
}

/// All commands, those of the grader in the place of their names.
std::vector<CommandHelp> all_commands(const CLI::App& app) {
  std::vector<CommandHelp> commands = commands_in(command_table(app));
  for (const CommandHelp& graders : commands_in(grader_table()))
    for (CommandHelp& command : commands)
      if (command.name == graders.name && command.words.empty()) command = graders;
  return commands;
}

/// A text in the words of troff.
std::string troff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out.starts_with(".") || out.starts_with("'") ? "\\&" + out : out;
}

std::string man_page(const CLI::App& app) {
  std::string page = fmt::format(
      ".TH CROSSCHECK 1 \"\" \"{}\" \"User Commands\"\n"
      ".SH NAME\ncrosscheck \\- compares mass\\-spring and cloth engines in numbers, plots and pictures\n"
      ".SH SYNOPSIS\n.B crosscheck\n.I COMMAND\n.RI [ OPTION ]...\n.SH DESCRIPTION\n{}\n"
      "Scenes are shipped ones or TOML files; a method is an engine with a stepper, or any program that speaks the "
      "engine "
      "protocol, as\n.BI exec: PATH.\n.SH COMMANDS\n",
      troff(program_and_version()), troff(app.get_description()));
  for (const CommandHelp& command : all_commands(app)) {
    page += fmt::format(".SS {}\n{}.\n", troff(command.name), troff(command.what));
    for (const auto& word : command.words) page += fmt::format(".TP\n.I {}\n{}\n", troff(word.name), troff(word.what));
    for (const auto& option : command.options) {
      if (option.names.back() == "--help") continue;
      page += fmt::format(".TP\n.BR {}{}\n{}\n", troff(fmt::format("{}", fmt::join(option.names, ", "))),
                          option.value.empty() ? "" : " \" \\fI" + troff(option.value) + "\\fR\"", troff(option.what));
    }
  }
  return page +
         ".SH EXIT STATUS\n0: done. 1: the answer is no. 2: bad use or bad input, with one line that says what was "
         "expected.\n"
         ".SH ENVIRONMENT\n.TP\n.B CROSSCHECK_CACHE\nthe folder of converged solutions, compiled coursework and "
         "adapters "
         "(default: crosscheck in $XDG_CACHE_HOME or ~/.cache)\n"
         ".SH EXAMPLES\n.nf\ncrosscheck report\ncrosscheck compare cloth\\-hang \\-\\-methods "
         "leapfrog,bullet/deformable\\-explicit\ncrosscheck check exec:./engine\n.fi\n";
}

/// What `list` shows that a word of a command may be; empty where it is none of that.
std::string_view kinds_of(const CommandHelp& command, const std::string& word) {
  if (word == "SCENE" || word == "scenes") return "scenes";
  if (word == "METHOD") return "methods scenes";
  if (word == "ASSIGNMENT" || command.name == "assignment") return "assignments";
  if (command.name == "experiment") return "experiments scenes";
  if (command.name == "figures") return "experiments";
  return "";
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string cases;
  for (const CommandHelp& command : all_commands(app)) {
    names.push_back(command.name);
    std::vector<std::string> options;
    for (const auto& option : command.options) options.insert(options.end(), option.names.begin(), option.names.end());
    std::vector<std::string> kinds;
    for (const auto& word : command.words)
      if (const auto kind = kinds_of(command, word.name); !kind.empty()) kinds.emplace_back(kind);
    cases += fmt::format("    {}) options=\"{}\" kinds=\"{}\" words=\"{}\" ;;\n", command.name, fmt::join(options, " "),
                         fmt::join(kinds, " "), command.name == "list" ? "scenes methods experiments assignments" : "");
  }
  return fmt::format(
      R"sh(# bash completion of crosscheck: commands, their options, and the names that `crosscheck list` knows
_crosscheck() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} options="" kinds="" words="" kind
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$cur")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $prev in
    --method | --methods | --against) kinds=methods ;;
  esac
  case $cur in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur") ;;
    *)
      mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
      for kind in $kinds; do
        mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -W "$("${{COMP_WORDS[0]}}" list "$kind" 2>/dev/null | cut -d' ' -f1)" -- "$cur")
      done
      mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$cur") ;;
  esac
}}
complete -o filenames -F _crosscheck crosscheck
)sh",
      fmt::join(names, " "), cases);
}

int manual_command(const CLI::App& app, const std::string& form) {
  if (form != "man" && form != "bash") throw InputError(fmt::format("manual {}: expected man or bash", form));
  fmt::print("{}", form == "man" ? man_page(app) : bash_completion(app));
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
