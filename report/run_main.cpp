// crosscheck_run: `run` and `validate` alone, with the options that they have in crosscheck. It is built in a fraction
// of the time.

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "report/commands/command_line.h"

using namespace crosscheck;

int main(int argc, char** argv) {
  return run_supervised([&] {
    return run_reporting_errors("crosscheck", [&] {
      CLI::App app{"Crosscheck's single runs."};
      app.require_subcommand(1);
      int status = 0;
      add_single_run(app, command_line(argc, argv), status);
      return parse(app, argc, argv, status);
    });
  });
}
