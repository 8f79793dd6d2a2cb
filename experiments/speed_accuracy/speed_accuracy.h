// Experiment `speed-accuracy`: error against cost of every method on a scene, at many steps or tolerances.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tables/speed_accuracy.h"
#include "reference/method.h"

namespace crosscheck {

// The steps and tolerances at which a method is tried on a scene, and what is timed of each run.

struct Setting {
  bool tolerance;  // else a step
  double value;    // s; tolerances 1
  SettingKind kind() const { return tolerance ? SettingKind::tolerance : SettingKind::step; }
  /// The run at this setting.
  Run applied_to(Run run) const;
};

/// The longest step by theory at which the method's rule holds when the scene begins, s; infinite where none is known.
double stability_limit(const Method& method, const Scene& scene);

/// The ladder of steps begins with 2^longest_halving times the run's step.
inline constexpr int longest_halving = 6;
/// True if the ladder passes over a step h (s): one or two that fail show where the others end.
inline bool is_beyond(double limit, int halving, double h) { return halving > 3 && h > 2 * limit; }

/// Fixed steps, halved from 64 times the run's step down to a 16th of it; of those above 8 times only what is at most
/// twice the limit of a rule whose limit is known. Steps longer than the sampling interval are one and the same: that
/// one. Tolerances from 1e-2 to 1e-8 (full: 1e-10). Left out is what, by an estimate that is the same on every machine,
/// would take more than 0.35 s of CPU time (1.8 s at the run's own step and longer ones); without `full` 0.7 times as
/// much, and tolerances whose runs would take more than 1.3 s. `dropped` counts those.
std::vector<Setting> settings_of(const Method& method, const Scene& scene, const Run& run, bool full,
                                 int* dropped = nullptr);

/// The timed part of a run: the whole, or its first part.
struct TimedPart {
  Run run;
  double share = 1;  // of the run's steps or samples
};
/// As much as takes about 20 ms by the estimate, or, of adaptive methods, by how the run begins. The whole run where
/// that takes less than 0.05 s (`full`: 0.2 s) or something may be touched (that may cost more than falling), of
/// outside programs, and with `whole`.
TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting, bool full,
                  bool whole = false);

/// Distance of two runs over the samples that both have, up to a time: RMS over the particles, m.
struct TrajectoryDistance {
  double largest = 0;    // over time
  double over_time = 0;  // RMS over time too
};
TrajectoryDistance distance_over_time(const Trajectory& a, const Trajectory& b, double until);

/// Rows of `speed-accuracy`: no time in them. Besides the ladder the steps of the search for the cheapest run within
/// 1 % of the motion (step_search.h), and of other engines those between the last that misses it and the first that
/// does not. Notes say what was left out.
void speed_accuracy_on(const Request& request, const Scene& scene, TableSet& tables);
/// Rows of `speed-accuracy-timing-cost`: the runs of `rows` timed in turns. Long runs are timed over their first part,
/// as each evaluation of a scene without contact costs the same; the recommended run, its ties and the cheapest run of
/// each other engine within 1 % of the motion are timed whole.
void time_speed_accuracy(const Request& request, const Scene& scene, const TableSet& rows, TableSet& tables);

/// The part of the motion within which the report recommends a run.
inline constexpr double recommended_part = 0.01;

/// The build of the code whose time is measured.
std::string build_of(const std::string& method);

}  // namespace crosscheck
