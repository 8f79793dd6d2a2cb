// regress --prove-speed: a build beside itself, again and again; no alarm is right.
#include <fmt/format.h>

#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/output_folder.h"
#include "report/commands/regress_speed.h"

namespace crosscheck {
namespace {

struct Tally {
  int suspicions = 0, alarms = 0;
  double farthest = 1;  // of the changes seen
  std::string where;
};

void look(const std::vector<SpeedQuestion>& questions, const SpeedFile& blessed, const Machine& machine,
          const Measure& measure, Tally& tally) {
  int measurements = 0;
  const Measure counted = [&](const std::vector<SpeedQuestion>& asked, const SpeedPlan& plan) {
    // all that are measured again after the first look are under suspicion
    if (++measurements == 2) tally.suspicions += static_cast<int>(asked.size());
    return measure(asked, plan);
  };
  for (const SpeedCompared& row : compared_speeds(questions, &blessed, machine, counted).rows) {
    const double change = std::max(row.change.median, 1 / row.change.median);
    if (change > tally.farthest) tally.farthest = change, tally.where = row.scene + " under " + row.method;
    if (row.state == Pace::same) continue;
    ++tally.alarms;
    fmt::print("{:<10} {}, {}: {:.4g} times the plain loop, was {:.4g}; noise {:.0f} %\n", name_of(row.state),
               row.scene, row.method, row.is, row.was.value_or(0), 100 * row.noise);
    std::fflush(stdout);
  }
}

}  // namespace

int prove_speed_command(const RegressOptions& options) {
  OutputFolder folder(options.out, "regress");
  Asked asked;
  asked.filter = options.filter;
  if (!options.methods.empty()) asked.methods = find_methods(options.methods);
  const std::vector<SpeedQuestion> questions = speed_questions(asked, {});
  if (questions.empty()) throw InputError("--prove-speed: no speed is asked of what the filter leaves");
  Machine machine = machine_of(provenance(options.command_line));
  if (machine.cpu.empty()) machine.cpu = "this one";  // nothing of it is kept
  Progress progress(0);
  const Measure measure = SpeedMeter(folder.path(), progress);
  SpeedFile blessed;
  put_into(blessed, speeds_to_bless(questions, machine, measure), {});
  Tally tally;
  for (int i = 0; i < options.repetitions; ++i) look(questions, blessed, machine, measure, tally);
  progress.done();
  folder.finish();
  fmt::print("{} repetitions of {} speeds: {} suspicions, {} alarms; the farthest off was {} by {:.3g}\n",
             options.repetitions, blessed.speeds.size(), tally.suspicions, tally.alarms, tally.where, tally.farthest);
  return tally.alarms == 0 ? 0 : 1;
}

}  // namespace crosscheck
