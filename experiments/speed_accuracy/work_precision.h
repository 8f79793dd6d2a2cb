// Work-precision analysis: Pareto fronts, and the cheapest method and engine within a given accuracy.
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
  std::optional<double> error;      // m; empty if the run failed
  double cost;                      // evaluations, or s
  std::optional<Timing> time = {};  // set if the cost is time
  double part = 1;                  // timed fraction of the run, from which the time of the whole run is extrapolated
};

/// The Pareto front, from cheap to expensive. Errors below `floor` (m) count as equal to it.
std::vector<WorkPrecisionPoint> pareto_line(std::vector<WorkPrecisionPoint> points, double floor);

/// The cheapest run with an error of at most `bound` among eligible families; nullptr if there is none.
const WorkPrecisionPoint* cheapest(const std::vector<WorkPrecisionPoint>& points, double bound,
                                   const FamilyFilter& is_eligible = {});

/// Other methods whose cheapest run within the bound takes a time that cannot be distinguished from that of `best`,
/// given the relative noise.
std::vector<std::string> statistically_tied(const std::vector<WorkPrecisionPoint>& points,
                                            const WorkPrecisionPoint& best, double bound, double noise);

/// Name of a method's engine: "mysim" for "mysim/leapfrog". The user's programs and trajectories are separate engines:
/// "exec:./a".
std::string engine_of(const std::string& method);

/// Adds an EngineSpeedRow for each engine with a timed run within `bound` (m), from which the truth's error bar is
/// already subtracted. The row has the engine's cheapest run, and the ratio of its time to that of mysim's cheapest
/// run. `low` and `high`: extremes of the ratio that the 90 % intervals of both times allow. There is no ratio if no
/// run of mysim is within the bound.
void add_by_engine(const std::string& scene, double part_of_motion, Measure measure, double bound,
                   const std::vector<WorkPrecisionPoint>& points, Table& table);

}  // namespace crosscheck
