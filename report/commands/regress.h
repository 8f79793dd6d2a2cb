// regress: its options, the proofs that it can be trusted, and the speed of methods on the terminal.
#pragma once

#include "experiments/regress/regress.h"
#include "experiments/regress/speed_regression.h"
#include "report/base/provenance.h"

namespace crosscheck {

struct RegressOptions {
  std::string filter, methods, against, reason;
  std::filesystem::path baselines;  // empty: the shipped ones
  bool full = false, bless = false, bisect = false, prove = false, prove_builds = false;
  std::vector<std::string> scenes;       // names or files; empty: all shipped ones
  int figures = 6;                       // of so many failed cases
  std::string mutant;                    // with `prove`, one of the wrong changes; empty: all
  std::string build;                     // with `prove_builds`, one of the builds; empty: all
  bool no_speed = false, speed = false;  // speed is measured too, when bisecting only where it is requested
  bool prove_speed = false;
  int repetitions = 200;  // of `prove_speed`
  std::filesystem::path out = "out/regress";
  std::string command_line;
};

/// Runs the mutants against the baselines and says which were caught. 1 where one escaped, where a cause was named
/// wrongly, or where mysim as it is was caught.
int prove_command(const RegressOptions& options);
/// Measures the speeds of this program against its own, again and again. 1 where any of them raised an alarm.
int prove_speed_command(const RegressOptions& options);
/// Builds Crosscheck in other ways and runs each against the baselines: none of them may fail. 1 where one
/// does, or could not be built; InputError where there is no such build.
int prove_builds_command(const RegressOptions& options);

/// The blessed results that come with the program.
std::filesystem::path shipped_baselines();

/// This machine and this program.
Machine machine_of(const Provenance& lines);

SpeedRun speed_run_of(const Regression& regression, const Provenance& lines);

/// Measures, compares, and explains each change.
Speeds speeds_beside(const Regression& regression, const Provenance& lines, const std::vector<Comparison>& comparisons,
                     Progress& progress);

/// One line for each change, and what was not compared and why.
void print_speeds(const Speeds& speeds);

/// Blesses speeds, and says which.
void bless_and_print_speeds(const Regression& regression, const Blessing& blessing, const Provenance& lines);

}  // namespace crosscheck
