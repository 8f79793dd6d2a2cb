// Analysis of errors and costs: Pareto lines, and the cheapest method and engine within an accuracy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/speed_accuracy.h"
#include "experiments/timing/timing.h"
#include "reference/method.h"

namespace crosscheck {

// Work-precision analysis of runs: the Pareto line, and the cheapest run within an accuracy.

/// One run: where it lies on a chart of error against cost.
struct WorkPrecisionPoint {
  std::string method;
  SettingKind setting;
  double requested;  // s or 1
  bool ok;
  std::optional<double> error;      // m; of runs that are ok
  double cost;                      // evaluations, or s
  std::optional<Timing> time = {};  // where the cost is time
  double part = 1;                  // of the run that was timed; the rest is scaled
};

/// The runs that no cheaper run beats, from cheap to expensive, each with a smaller error than the one before. An error
/// below the floor (m) counts as the floor: those below it are equal.
std::vector<WorkPrecisionPoint> pareto_line(std::vector<WorkPrecisionPoint> points, double floor);

/// The cheapest run with an error of at most `bound`, of the families that are eligible; null where there is none.
const WorkPrecisionPoint* cheapest(const std::vector<WorkPrecisionPoint>& points, double bound,
                                   const FamilyFilter& is_eligible = {});

/// Other methods whose cheapest run within the bound cannot be distinguished from the best one's by their times, given
/// the noise (relative).
std::vector<std::string> statistically_tied(const std::vector<WorkPrecisionPoint>& points,
                                            const WorkPrecisionPoint& best, double bound, double noise);

// The cheapest run of each engine within an accuracy, compared with mysim's.

/// The engine of a method: "mysim" of "mysim/leapfrog". A program or a trajectory of the reader's is one itself:
/// "exec:./a".
std::string engine_of(const std::string& method);
/// What a method is called where its engine is named as well: "leapfrog", "exec:./a".
std::string name_beside_engine(const std::string& method);

/// Adds an EngineSpeedRow for each engine that has a timed run within `bound` (m), what the truth's bar takes off
/// included: its cheapest, and how many times as long as mysim's cheapest it takes, from `low` to `high` the widest
/// that both 90 % intervals allow; and which part of each was timed, the rest being scaled. Without a run of mysim
/// within the bound no quotient is given.
void add_by_engine(const std::string& scene, double part_of_motion, Measure measure, double bound,
                   const std::vector<WorkPrecisionPoint>& points, Table& table);

}  // namespace crosscheck
