// The subcommands: each registers itself and its options, and is one row of the table in main.cpp.
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

/// One call of the program.
struct Invocation {
  std::string line;  // the command line as a person would type it
  int status = 0;    // of the exit: 0 done, 1 a negative result; bad input throws InputError (exit 2)
};

using AddCommand = void (*)(CLI::App&, Invocation&);

/// Reads the command line, runs its command, and returns the exit status. Throws InputError that names the nearest
/// word.
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

/// `grade` and `assignment`, by their names alone: the grader knows their options.
void add_grader(CLI::App& app, Invocation& call);
/// Becomes the grader, found next to this program, with these arguments; where a page of one submission is requested,
/// starts it, and compares the student's steppers with other engines in a report next to the page. Throws
/// std::runtime_error where the grader is not built.
int grader_command(const std::vector<std::string>& words);
/// The grader's commands as command_table() writes them (mysim/base/command_line.h).
std::string grader_table();

/// `manual`, which no --help shows: the build writes the manual page and the shell's completions with it.
void add_manual(CLI::App& app, Invocation& call);

struct ReportOptions {
  std::vector<std::string> scenes;
  std::string methods;
  std::string engines = {};  // "all": with every engine that `engine NAME` has built
  bool full = false;
  std::vector<std::string> experiments = {};  // those with chapters; empty: all
  std::filesystem::path against = {};         // an earlier report, or empty
  std::filesystem::path out = "out/report";
  std::string command_line;
};
/// Writes the report into a folder that is held already, whatever `out` says.
int report_command(const ReportOptions& options, OutputFolder& folder);

}  // namespace crosscheck
