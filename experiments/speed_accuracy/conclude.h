// What follows from runs and their costs: the Pareto line, and who meets an accuracy at the least cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/timing.h"

namespace crosscheck {

/// One run: where it lies on a chart of error against cost.
struct WorkPoint {
  std::string method, setting;  // setting: "step [s]" or "tolerance [1]"
  double asked;                 // s or 1
  bool ok;
  std::optional<double> error;      // m; of runs that are ok
  double cost;                      // evaluations, or s
  std::optional<Timing> time = {};  // where the cost is time
  double part = 1;                  // of the run that was timed; the rest is scaled
};

/// The runs that no cheaper run beats, from cheap to dear, each with a smaller error than the one before. An error
/// below the floor (m) counts as the floor: among those below it nobody is better.
std::vector<WorkPoint> pareto_line(std::vector<WorkPoint> points, double floor);

/// The cheapest run with an error of at most `bound`, of the methods whose name begins with `prefix`; null where there
/// is none.
const WorkPoint* cheapest(const std::vector<WorkPoint>& points, double bound, const std::string& prefix = "");

/// Other methods whose cheapest run within the bound cannot be told from the best one's by their times, given the noise
/// (relative).
std::vector<std::string> as_cheap(const std::vector<WorkPoint>& points, const WorkPoint& best, double bound,
                                  double noise);

}  // namespace crosscheck
