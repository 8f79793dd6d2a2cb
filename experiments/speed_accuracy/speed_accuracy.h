// Experiment `speed-accuracy`: error versus cost of every method on a scene, at many steps or tolerances.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tables/speed_accuracy.h"
#include "reference/method.h"

namespace crosscheck {

struct Setting {
  bool tolerance;  // otherwise a step
  double value;    // s; for tolerances 1
  SettingKind kind() const { return tolerance ? SettingKind::tolerance : SettingKind::step; }
  Run applied_to(Run run) const;
};

/// Largest stable step (s) of the method's rule at the start of the scene by linear theory; infinite if unknown.
double stability_limit(const Method& method, const Scene& scene);

/// The ladder of steps begins at 2^longest_halving times the run's step.
inline constexpr int longest_halving = 6;
/// True if the ladder skips a step h (s): one or two failing steps suffice to show that longer ones fail, too.
inline bool is_beyond(double limit, int halving, double h) { return halving > 3 && h > 2 * limit; }

/// Fixed steps, halved from 64 times the run's step down to a 16th of it. Steps above 8 times the run's step are
/// limited to twice the rule's stability limit, if known, and all steps to the sampling interval. Tolerances range from
/// 1e-2 to 1e-8 (full: 1e-10). Leaves out runs whose estimated CPU time (the same on every machine) exceeds 0.14 s, or
/// 0.72 s at the run's own step and longer ones; full: 2.5 times as much. Unless full, also leaves out tolerances whose
/// runs would take more than 1.3 s. `dropped` counts the omissions.
std::vector<Setting> settings_of(const Method& method, const Scene& scene, const Run& run, bool full,
                                 int* dropped = nullptr);

struct TimedPart {
  Run run;
  double share = 1;  // fraction of the run's steps or samples
};
/// A part of the run that takes about 6 ms (full: 20 ms), as predicted by the estimate or, for adaptive methods, by the
/// beginning of the run. The whole run if it takes less than 12 ms (full: 0.2 s), if the scene has contact (which may
/// cost more than the fall at the beginning), for external programs, or if `whole` is set.
TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting, bool full,
                  bool whole = false);

/// RMS distance (m) of the particles of two runs at their common samples up to time `until`.
struct TrajectoryDistance {
  double largest = 0;    // maximum over time
  double over_time = 0;  // RMS over time
};
TrajectoryDistance distance_over_time(const Trajectory& a, const Trajectory& b, double until);

/// Adds the rows of `speed-accuracy`, without times. In addition to the ladder, these contain the steps of the search
/// for the cheapest run within 1 % of the motion (step_search.h) and, for other engines, steps between the last run
/// that misses that accuracy and the first run that meets it. Notes list the omissions.
void speed_accuracy_on(const Request& request, const Scene& scene, TableSet& tables);
/// Adds the rows of `speed-accuracy-timing-cost`: the runs of `rows`, timed in turns. For long runs, only the first
/// part is timed (part_of()). The recommended run, its ties, and each other engine's cheapest run within 1 % of the
/// motion are timed whole.
void time_speed_accuracy(const Request& request, const Scene& scene, const TableSet& rows, TableSet& tables);

/// Required accuracy of the run that the report recommends, as a fraction of the motion.
inline constexpr double recommended_part = 0.01;

/// Name of the build that contains the timed code of a method.
std::string build_of(const std::string& method);

}  // namespace crosscheck
