#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/base/this_process.h"
#include "report/commands/commands.h"

using namespace crosscheck;

namespace {

// in the order of --help
constexpr AddCommand commands[] = {
    add_doctor, add_list,   add_validate, add_run,   add_compare, add_experiment, add_merge,  add_report, add_figures,
    add_render, add_advise, add_regress,  add_bench, add_check,   add_translate,  add_engine, add_lab,    add_grader,
    add_manual,  // hidden
};

int run(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word == "grade" || word == "assignment") return grader_command({argv + 1, argv + argc});
  return run_command_line(commands, argc, argv);
}

/// Command line that resumes an interrupted command; empty if the command must start over.
std::string resumption(std::vector<std::string> words) {
  const auto given = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  const std::string command = words.size() > 1 ? words[1] : "";
  if (command == "grade" && given("--all")) return "the same command continues it";
  if (command != "experiment") return "";
  if (!given("--resume")) words.emplace_back("--resume");
  words[0] = "crosscheck";
  return "`" + shell_join(words) + "` continues it";
}

}  // namespace

int main(int argc, char** argv) {
  return run_supervised([&] { return run_reporting_errors("crosscheck", [&] { return run(argc, argv); }); },
                        resumption({argv, argv + argc}));
}
