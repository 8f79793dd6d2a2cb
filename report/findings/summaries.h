// Summaries of single tables, which findings and figures share.
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

// The relative energy residual of a long run.

inline constexpr auto residual_bounded = "bounded", residual_none = "zero to round-off";

/// Of a run that claims closure; of one that failed, the word for its failure.
std::string residual_class(const EnergyRow& run);
inline bool is_bounded(const std::string& word) { return word == residual_bounded || word == residual_none; }

// Grids, from experiment `adequacy`: powers of the number of cells.

/// The fitted power of a quantity from table `adequacy-scaling`; `scene` is empty for bend springs.
std::optional<PowerLaw> power_of(const TableSet& rows, const std::string& scene, ScalingQuantity quantity);
/// "4.24 ± 0.03"
std::string power_text(const PowerLaw& power);

/// "bend and shear springs" of "bend springs, shear springs", "nothing", or of more than `most` "4 ingredients".
std::string ingredients_text(const std::string& left_out, size_t most = 3);

/// The step of the rows that is nearest to a millisecond, s.
template <class Row>
double usual_step(const std::vector<Row>& rows) {
  return std::ranges::min(rows, {}, [](const Row& row) { return std::abs(row.step - 1e-3); }).step;
}

// Particles on slopes, from tables `sphere-cone` and `plane-cone`.

/// Of a method's cases, how many end as Coulomb's law says; runs that failed are left out.
struct ConeCount {
  std::string method;
  long right = 0, all = 0;
};
std::vector<ConeCount> cone_counts(const std::vector<ConeRow>& rows);
std::vector<ConeRow> plane_cones(const TableSet& rows);
/// The count of one method, or null.
const ConeCount* count_of(const std::vector<ConeCount>& counts, const std::string& method);

// Measured stability limits against theory, from table `stability`.

/// The rows of one state that theory speaks of, unless it has its limit beyond what was tried.
struct StepLimitCounts {
  size_t agreeing = 0;              // within 1 %
  double deviation = 0;             // largest deviation of these, over the predicted step
  std::vector<std::string> scenes;  // of these
  size_t coarse = 0;                // further off, but theory's limit lies between what held and what failed
  double widest = 0;                // bracket of both kinds, over what held
  size_t apart = 0;                 // all others
  std::string method, where;        // of these the one that is furthest off
  size_t all() const { return agreeing + coarse + apart; }
  std::string how;  // "stable at 47 times the step", "holds at every step tried, by theory up to 1.2 ms"
};
StepLimitCounts step_limit_counts(const std::vector<LimitRow>& rows, LimitState state);

/// Whether the truth of a scene without rest says that a run just below the limit is of use and one just above is not.
/// False where it was not asked.
bool confirmed_by_truth(const LimitRow& row);

/// "-0.12 %", "47 times as long": of measured over predicted, less 1; "within ±0.07 %" where it is less than what the
/// search can resolve, `finest`.
std::string deviation_text(double off, double finest = 0);

}  // namespace crosscheck
