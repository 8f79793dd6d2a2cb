// Summaries of single tables, in words that a finding and a figure share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/adequacy/resolution.h"
#include "experiments/experiment.h"
#include "experiments/tables/table.h"
#include "report/findings/report_data.h"

namespace crosscheck {

// The relative energy residual of a long run.

inline constexpr auto residual_bounded = "bounded", residual_none = "zero to round-off";

/// Of a row of table `energy` that claims closure; of a run that failed, the word for its failure.
inline std::string residual_class(const Table& energy, size_t row) {
  const double worst = number_at(energy, row, "largest residual", 0),
               turned = number_at(energy, row, "energy turned over", 0),
               growth = number_at(energy, row, "growth of the residual", 0),
               last = number_at(energy, row, "residual", 0);
  if (const std::string& verdict = text_at(energy, row, "verdict"); verdict != "ok") return failure_class(verdict);
  // a hundred thousand roundings of the energies that are added up
  if (worst < 1e-11 * turned) return residual_none;
  if (worst > 0.3 * turned) return last < 0 ? "takes much of the energy" : "makes much energy";
  // half a decade more than in the first tenth: in proportion to time it is a whole one
  if (growth > 0.5) return last < 0 ? "drifts down" : "drifts up";
  return residual_bounded;
}
inline bool is_bounded(const std::string& word) { return word == residual_bounded || word == residual_none; }

// Grids, from experiment `adequacy`: powers of the number of cells.

inline constexpr auto motion_against_cells = "error of the motion against cells along a side",
                      stiffness_for_sag = "stiffness of all springs for the same sag",
                      stiffness_for_droop = "stiffness of bend springs for the same droop";

/// The fitted power of a quantity from table `adequacy-scaling`; `scene` is empty for bend springs.
std::optional<PowerLaw> power_of(const Rows& rows, const std::string& scene, const std::string& quantity);
/// "4.24 ± 0.03"
std::string power_text(const PowerLaw& power);

/// The power by which bend springs must stiffen against the derived 4, with the cause of the difference: the derivation
/// counts as many bend springs as cells, and a line has half a one less, as none crosses the free end. Empty where
/// nothing was fitted.
std::string bend_sentence(const Rows& rows);

// The least models of scenes, from table `adequacy-least`.

/// The least model that was found within one tolerance.
struct LeastModel {
  std::string tolerance;  // "the scene's own", "1 % of its motion", "10 % of its motion"
  std::string left_out;   // "shear springs, bend springs"; empty: nothing
  bool holds;             // from starts that the search had not seen, too
  int failing, starts;    // of these starts, how many are beyond the tolerance, of how many
  double cost;            // of the full model's
  bool of_motion(int percent) const { return tolerance.starts_with(std::to_string(percent) + " %"); }
};
/// From the strictest tolerance of the table on, in its order; empty where the scene was not run.
std::vector<LeastModel> least_models_of(const Rows& rows, const std::string& scene);

/// The scene's ingredients (table `adequacy`) that stay when those are left out.
std::vector<std::string> kept_without(const Rows& rows, const std::string& scene, const std::string& left_out);

// The error of the angle at which particles leave a ball.

/// Of table `sphere-leaving`: mysim's rules together, every other method by itself, at the finest step and at the
/// longest. Empty where no particle leaves.
std::string leaving_sentence(const Table& leaving);

// The final place of the cloth of scene drop-aside, which should slide off its ball.

/// A method's last state, at the finest step of mysim/symplectic-euler.
struct DrapeEnd {
  std::string method;
  double height, end;           // m, of the centre; s
  std::optional<double> creep;  // m/s, of the particles that touch; empty where none does
  /// "still touches it, sliding at 1.95 mm/s"
  std::string contact_text() const;
};

/// Of table `sphere-drape`: mysim/symplectic-euler first, then those of Bullet and the sticky sphere, as far as they
/// came to the end. Empty where mysim/symplectic-euler did not.
std::vector<DrapeEnd> drape_ends(const Table& drapes);
/// "At 1.6 s it is off the ball with a and b; with c it still touches it, frozen."
std::string drape_end_sentence(const std::vector<DrapeEnd>& ends);

// Measured stability limits against theory, from table `stability`.

/// A largest stable step by theory, and the one measured.
struct StepLimitComparison {
  enum Kind {
    agrees,  // within 1 %, or both say that no step, or every step, is stable
    coarse,  // further off, but the search ended with theory's limit between what held and what failed
    apart
  } kind = agrees;
  std::optional<double> off;  // measured over predicted, less 1; where both are steps
  std::string how;            // of `apart`: "47 times as long", "holds at every step tried, by theory up to 1.2 ms"
};
/// Nothing where there is no theory, the method does not take the scene, or theory's limit lies beyond what was tried.
std::optional<StepLimitComparison> compare_step_limit(const Table& stability, size_t row);

/// A sentence on the limits of all scenes that can rest, and one on those that theory treats about their start.
struct StepLimitSummary {
  std::string sentence;
  bool at_rest, theory_holds;  // theory holds where no row is `apart`
};
std::vector<StepLimitSummary> step_limit_summaries(const Table& stability);

/// "-0.12 %", "47 times as long": of measured over predicted, less 1; "within ±0.07 %" where it is less than what the
/// search can resolve, `finest`.
std::string deviation_text(double off, double finest = 0);

}  // namespace crosscheck
