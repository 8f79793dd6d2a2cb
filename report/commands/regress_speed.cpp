// What the run says of speed.
#include "report/commands/regress_speed.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/regress/machine.h"
#include "experiments/regress/plain_loop.h"
#include "experiments/regress/trade.h"

namespace crosscheck {

bool speed_is_asked(const RegressOptions& options) { return !options.no_speed && (!options.bisect || options.speed); }

Machine machine_of(const Provenance& lines) {
  std::string compiler = value_of(lines, "compiler");
  if (const std::string flags = CROSSCHECK_LINK_FLAGS; !flags.empty()) compiler += " " + flags;
  return {processor_kind(), compiler, PlainLoop::name};
}

SpeedRun speed_run_of(const Regression& regression, const Provenance& lines) {
  return {regression.asked, regression.against, regression.baselines, regression.out, machine_of(lines)};
}

Speeds speeds_beside(const Regression& regression, const Provenance& lines, const std::vector<Compared>& answers,
                     Progress& progress) {
  Speeds speeds = compared_speeds(speed_run_of(regression, lines), progress);
  speeds.trades = tell_trades(speeds.rows, answers);
  return speeds;
}

void print_speeds(const Speeds& speeds) {
  const auto count = [&](Pace state) {
    return std::count_if(speeds.rows.begin(), speeds.rows.end(),
                         [&](const SpeedCompared& row) { return row.state == state; });
  };
  for (const SpeedCompared& row : speeds.rows)
    if (row.state == Pace::slower || row.state == Pace::faster)
      fmt::print(
          "{:<10} {}, {}: {}\n           {:.4g} times the plain loop, was {:.4g}; noise {:.0f} %, seen in {} more "
          "measurements\n",
          name_of(row.state), row.scene, row.method, row.sentence, row.is, *row.was, 100 * row.noise, row.seen);
  for (const SpeedCompared& row : speeds.rows)
    if (row.state == Pace::gone) fmt::print("gone       {}, {}: {}\n", row.scene, row.method, row.note);
  for (const FailedPoint& f : speeds.failures) fmt::print("no speed   {}: {}\n", f.name, f.why);
  const auto compared = count(Pace::slower) + count(Pace::faster) + count(Pace::same);
  if (compared > 0)
    fmt::print("{} speeds: {} the same within the noise, {} slower, {} faster\n", compared, count(Pace::same),
               count(Pace::slower), count(Pace::faster));
  for (const std::string& note : speeds.notes) fmt::print("{}\n", note);
}

void bless_and_print_speeds(const Regression& regression, const Blessing& blessing, const Provenance& lines) {
  const SpeedRun run = speed_run_of(regression, lines);
  if (run.machine.cpu.empty()) {
    fmt::print("no speeds blessed: this processor cannot be told from others\n");
    return;
  }
  Progress progress(0);
  const std::vector<BlessedSpeed> written = bless_speeds(run, blessing, progress);
  progress.done();
  for (const BlessedSpeed& speed : written)
    fmt::print("speed      {}, {}: {:.4g} times the plain loop, spread {:.1f} %\n", speed.scene, speed.method,
               speed.ratio, 100 * speed.spread);
  fmt::print("{} speeds blessed\n", written.size());
  if (!written.empty()) fmt::print("{}\n", speed_file_in(regression.baselines).string());
}

}  // namespace crosscheck
