// crosscheck: the table of its commands. A new command is a file in commands/ and a row here.

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/base/this_process.h"
#include "report/commands/commands.h"

using namespace crosscheck;

namespace {

// in the order of --help
constexpr AddCommand commands[] = {
    add_doctor,      // programs and libraries
    add_list,        // scenes, methods, experiments
    add_validate,    // checks scene files
    add_run,         // one method on one scene
    add_compare,     // compares methods on one scene
    add_experiment,  // tables of measurements
    add_merge,       // joins the shards of an experiment
    add_report,      // the page
    add_figures,     // charts and pictures for print
    add_render,      // a picture
    add_advise,      // the cheapest method for a tolerance
    add_regress,     // compares results with baselines
    add_bench,       // speed compared with the peers
    add_check,       // relations that need no truth; protocol conformance of an adapter
    add_translate,   // parameters of a scene in another engine's units
    add_engine,      // builds another version of Bullet
    add_lab,         // a page with the live lab alone
    add_grader,      // grade and assignment
    add_manual,      // the manual page and the shell's completions; hidden
};

int run(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word == "grade" || word == "assignment") return grader_command({argv + 1, argv + argc});
  return run_command_line(commands, argc, argv);
}

/// Command that resumes an interrupted command; empty for commands that start over.
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
