// crosscheck_run: `run` and `validate` alone, with the options that they have in crosscheck. It is built in a fraction
// of the time.

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "report/commands/command_line.h"

using namespace crosscheck;

namespace {

constexpr AddCommand commands[] = {add_validate, add_run};

}  // namespace

int main(int argc, char** argv) {
  return run_supervised([&] {
    return run_reporting_errors(
        "crosscheck", [&] { return run_command_line("Crosscheck's single runs.", "", commands, argc, argv); });
  });
}
