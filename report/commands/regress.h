// regress: the speed of methods, on the terminal.
#pragma once

#include "experiments/regress/regress.h"
#include "experiments/regress/speed_regression.h"
#include "report/base/provenance.h"
#include "report/commands/commands.h"

namespace crosscheck {

bool speed_is_asked(const RegressOptions& options);

/// This machine and this program.
Machine machine_of(const Provenance& lines);

SpeedRun speed_run_of(const Regression& regression, const Provenance& lines);

/// Measured, compared, and with what each change was bought.
Speeds speeds_beside(const Regression& regression, const Provenance& lines, const std::vector<Comparison>& answers,
                     Progress& progress);

/// One line for each change, and what was not compared and why.
void print_speeds(const Speeds& speeds);

/// Blesses speeds, and says which.
void bless_and_print_speeds(const Regression& regression, const Blessing& blessing, const Provenance& lines);

}  // namespace crosscheck
