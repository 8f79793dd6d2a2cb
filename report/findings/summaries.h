#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/adequacy/resolution.h"
#include "experiments/experiment.h"
#include "experiments/tables/adequacy.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/stability.h"
#include "report/findings/report_data.h"

namespace crosscheck {

// Two classes of the relative energy residual of a long run.

inline constexpr auto residual_bounded = "bounded", residual_none = "zero to round-off";

/// Class of the energy residual of a run whose energy balance closes. For a failed run, describes the failure.
std::string residual_class(const EnergyRow& run);
inline bool is_bounded(const std::string& word) { return word == residual_bounded || word == residual_none; }

// Powers of the number of cells, from experiment `adequacy`.

/// Fitted exponent from table `adequacy-scaling`; `scene` is empty for bend springs.
std::optional<PowerLaw> power_of(const TableSet& rows, const std::string& scene, ScalingQuantity quantity);
/// "4.24 ± 0.03"
std::string power_text(const PowerLaw& power);

/// Names left-out ingredients: "bend and shear springs" for "bend springs, shear springs"; "nothing"; "4 ingredients"
/// if there are more than `most`.
std::string ingredients_text(const std::string& left_out, size_t most = 3);

/// The step (s) of the rows that is nearest to a millisecond.
template <class Row>
double usual_step(const std::vector<Row>& rows) {
  return std::ranges::min(rows, {}, [](const Row& row) { return std::abs(row.step - 1e-3); }).step;
}

// Summaries of the tables `sphere-cone` and `plane-cone`.

/// Number of completed cases that agree with Coulomb's law.
struct ConeCount {
  std::string method;
  long right = 0, all = 0;
};
std::vector<ConeCount> cone_counts(const std::vector<ConeRow>& rows);
std::vector<ConeRow> plane_cones(const TableSet& rows);
/// The count of a method, or null if there is none.
const ConeCount* count_of(const std::vector<ConeCount>& counts, const std::string& method);

// Comparison of measured stability limits with theory, from table `stability`. The last stable and the first failed
// step of a search form the bracket of that search.

/// Counts rows of one state whose theoretical limit is within the range of steps tried.
struct StepLimitCounts {
  size_t agreeing = 0;              // deviation of 1 % or less
  double deviation = 0;             // largest deviation of the agreeing rows, relative to the predicted step
  std::vector<std::string> scenes;  // scenes of the agreeing rows
  size_t coarse = 0;                // larger deviation, but the predicted limit is in the bracket
  double widest = 0;                // widest bracket of agreeing and coarse rows, relative to the stable step
  size_t apart = 0;
  std::string method, where;  // row with the largest deviation, among those neither agreeing nor coarse
  size_t all() const { return agreeing + coarse + apart; }
  std::string how;  // "stable at 47 times the step", "holds at every step tried, by theory up to 1.2 ms"
};
StepLimitCounts step_limit_counts(const std::vector<LimitRow>& rows, LimitState state);

/// True if the truth of a scene without a state of rest confirms a limit: runs just below the limit are useful, and
/// runs just above it are not. False if nothing was compared.
bool confirmed_by_truth(const LimitRow& row);

/// "-0.12 %" or "47 times as long" for `off` = measured / predicted - 1; "within ±0.07 %" if the deviation is below
/// `finest`, the resolution of the search.
std::string deviation_text(double off, double finest = 0);

}  // namespace crosscheck
