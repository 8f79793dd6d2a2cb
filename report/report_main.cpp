// crosscheck_report: the commands that make reports, figures and pictures, with the options that they have in
// crosscheck. It is built sooner, as it knows neither `regress` nor `bench` nor `advise`.

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "report/commands/command_line.h"

using namespace crosscheck;

namespace {

constexpr AddCommand commands[] = {add_compare, add_report, add_figures, add_render, add_lab};

}  // namespace

int main(int argc, char** argv) {
  return run_supervised([&] {
    return run_reporting_errors(
        "crosscheck", [&] { return run_command_line("Crosscheck's reports and figures.", "", commands, argc, argv); });
  });
}
