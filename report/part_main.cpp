// A program with only some of crosscheck's commands, so that it builds faster. CMakeLists.txt lists the commands:
// `report` and related ones for crosscheck_report, `run` and `validate` for crosscheck_run.

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "report/commands/commands.h"

using namespace crosscheck;

int main(int argc, char** argv) {
  static constexpr AddCommand commands[] = {CROSSCHECK_COMMANDS};
  return run_supervised(
      [&] { return run_reporting_errors("crosscheck", [&] { return run_command_line(commands, argc, argv); }); });
}
