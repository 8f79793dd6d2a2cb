// Work-precision analysis: Pareto fronts, and the cheapest method and engine within an accuracy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/speed_accuracy.h"
#include "experiments/timing/timing.h"
#include "reference/method.h"

namespace crosscheck {

struct WorkPrecisionPoint {
  std::string method;
  SettingKind setting;
  double requested;  // s or 1
  bool ok;
  std::optional<double> error;      // m; for runs that are ok
  double cost;                      // evaluations, or s
  std::optional<Timing> time = {};  // if the cost is time
  double part = 1;                  // timed fraction of the run; the rest is scaled up
};

/// The Pareto front, from cheap to expensive. Errors below the floor (m) count as equal to it.
std::vector<WorkPrecisionPoint> pareto_line(std::vector<WorkPrecisionPoint> points, double floor);

/// The cheapest run with an error of at most `bound`, among eligible families; null if there is none.
const WorkPrecisionPoint* cheapest(const std::vector<WorkPrecisionPoint>& points, double bound,
                                   const FamilyFilter& is_eligible = {});

/// Other methods whose cheapest run within the bound cannot be distinguished from `best` by its time, given the
/// relative noise.
std::vector<std::string> statistically_tied(const std::vector<WorkPrecisionPoint>& points,
                                            const WorkPrecisionPoint& best, double bound, double noise);

/// "mysim" for "mysim/leapfrog". The user's programs and trajectories are engines of their own: "exec:./a".
std::string engine_of(const std::string& method);
/// Short name of a method: "leapfrog", "exec:./a".
std::string name_beside_engine(const std::string& method);

/// Adds an EngineSpeedRow for each engine with a timed run within `bound` (m), from which the truth's error bar is
/// already subtracted: its cheapest run, and the ratio of its time to that of mysim's cheapest run. `low` and `high`
/// are the extremes that both 90 % intervals allow. Without a run of mysim within the bound there is no ratio.
void add_by_engine(const std::string& scene, double part_of_motion, Measure measure, double bound,
                   const std::vector<WorkPrecisionPoint>& points, Table& table);

}  // namespace crosscheck
