// Subcommands of crosscheck. Each registers itself with its options.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace crosscheck {

class OutputFolder;

struct Invocation {
  std::string line;
  int status = 0;  // exit status: 0 done, 1 a negative result; bad input throws InputError (exit 2)
};

using AddCommand = void (*)(CLI::App&, Invocation&);

/// Runs the command of a command line and returns its exit status. For an unknown word, throws InputError that suggests
/// the nearest known one.
int run_command_line(std::span<const AddCommand> commands, int argc, char** argv);

void add_doctor(CLI::App& app, Invocation& call);
void add_list(CLI::App& app, Invocation& call);
void add_validate(CLI::App& app, Invocation& call);
void add_run(CLI::App& app, Invocation& call);
void add_compare(CLI::App& app, Invocation& call);
void add_experiment(CLI::App& app, Invocation& call);
void add_merge(CLI::App& app, Invocation& call);
void add_report(CLI::App& app, Invocation& call);
void add_figures(CLI::App& app, Invocation& call);
void add_render(CLI::App& app, Invocation& call);
void add_advise(CLI::App& app, Invocation& call);
void add_regress(CLI::App& app, Invocation& call);
void add_bench(CLI::App& app, Invocation& call);
void add_check(CLI::App& app, Invocation& call);
void add_translate(CLI::App& app, Invocation& call);
void add_engine(CLI::App& app, Invocation& call);
void add_lab(CLI::App& app, Invocation& call);

/// Registers only the names `grade` and `assignment`; their options are defined in the grader.
void add_grader(CLI::App& app, Invocation& call);
/// Replaces this process by the grader, found next to this program. For a page of one submission, runs the grader as a
/// child instead, then compares the student's steppers with other engines in a report next to the page. Throws
/// std::runtime_error if the grader is not built.
int grader_command(const std::vector<std::string>& words);
/// Describes the grader's commands in the format of command_table() (mysim/base/command_line.h).
std::string grader_table();

/// Hidden from --help: the build writes the manual page and the shell completions with it.
void add_manual(CLI::App& app, Invocation& call);

struct ReportOptions {
  std::vector<std::string> scenes;
  std::string methods;
  std::string engines = {};  // "all": every engine that `engine NAME` has built
  bool full = false;
  std::vector<std::string> experiments = {};  // experiments that get a chapter; empty: all
  std::filesystem::path against = {};
  std::filesystem::path out = "out/report";
  std::string command_line;
};
/// Writes the report into a folder that the caller has opened; ignores `out`.
int report_command(const ReportOptions& options, OutputFolder& folder);

}  // namespace crosscheck
