// Trials of the speeds of `crosscheck regress`, not part of the suite: measures the speeds of this program against its
// own, again and again. `speed_trials [REPETITIONS] [FILTER]` (200, all cases); exits 1 when any of them raised an
// alarm.

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "experiments/regress/speed_regression.h"

using namespace crosscheck;

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::atoi(argv[1]) : 200;
  Selection selection;
  if (argc > 2) selection.filter = argv[2];
  const std::vector<SpeedCase> cases = speed_cases(selection, {});
  const Machine machine{"this one", "this one", PlainLoop::name};
  Progress progress(0);
  const auto folder = std::filesystem::temp_directory_path() / "crosscheck-speed-trials";
  const MeasureSpeeds measure = measurements_in(folder, LockPatience(), progress);
  SpeedFile blessed;
  merge_into(blessed, speeds_to_bless(cases, machine, measure), {});
  int twice = 0, alarms = 0;
  for (int i = 0; i < repetitions; ++i)
    for (const SpeedComparison& row : compared_speeds(cases, &blessed, machine, measure).rows) {
      twice += row.seen > 1;
      if (row.state == SpeedStatus::same) continue;
      ++alarms;
      fmt::print("{:<10} {}, {}: {:.4g} times the plain loop, was {:.4g}; noise {:.0f} %\n", name_of(row.state),
                 row.scene, row.method, row.is, row.was.value_or(0), 100 * row.noise);
    }
  progress.done();
  std::filesystem::remove_all(folder);
  fmt::print("{} repetitions of {} speeds: {} changes seen twice, {} alarms\n", repetitions, blessed.speeds.size(),
             twice, alarms);
  return alarms == 0 ? 0 : 1;
}
