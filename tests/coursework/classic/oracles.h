// Judges a probe's findings (probe/findings.h) by properties that hold for any constants: shares, signs, shapes. Runs
// only in the grader; the student's process only returns numbers.
#pragma once

#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

using probe::Findings;

/// Recomputes the findings of probe/forces.h from the answers of evalF that the student's process recorded. States and
/// questions are drawn again and not taken from that process. `answers` is a record in the format of probe/ask.h,
/// possibly forged; the findings are empty if it is malformed.
Findings replay(const Case& what, const Numbers& answers);

/// A number, or a share with its total.
struct Feature {
  double got, of = 0;
  Feature(double number, double all = 0) : got(number), of(all) {}
};
using Features = std::vector<Feature>;

/// The share good / all; 0 if `all` is 0.
Feature share(int good, int all);
/// 1 if all are positive, -1 if all are negative, 0 if all are neither; otherwise 0.5.
double sign(int plus, int minus, int all);
bool zero(const probe::Plain& v);
/// True if two single-precision results agree up to rounding.
bool close(const probe::Plain& a, const probe::Plain& b);

// The following comments list the features that a function returns, separated by `|`.

/// Number of entries returned by evalF per entry of the state | deterministic | stored state unchanged | depends on the
/// argument instead of the stored state
Features purity(const Findings& found);
/// Share of the `wanted` particles that exist | share of particles that are fixed or have x' = v | number of fixed
/// particles, which have x' = 0 or v' = 0 | share of fixed particles that stay: x' = 0, or v' = 0 and v = 0 at the
/// start
Features motion(const Findings& found, int wanted);
/// Gravity acts downwards on the moving particles (-1: upwards) | equal for all of them
Features gravity(const Findings& found);
/// gravity_on: downward acceleration of particle i (m/s^2), the median of the draws. drag_on: rate (1/s) at which the
/// velocity of row i decays, negative if the velocity grows. is_free: true if any of columns `first` to `last` in the
/// rows of particle i is nonzero.
double gravity_on(const Findings& found, std::size_t i);
double drag_on(const Findings& found, std::size_t i);
bool is_free(const Findings& found, std::size_t i, std::size_t first, std::size_t last);
/// w is the velocity drawn for a particle. proportional_drag: v' of particle i at velocity 2 w, extrapolated from its
/// v' at rest and at w. is_proportional: true if the v' measured at 2 w, while all other particles move at w, is close
/// to this value.
probe::Plain proportional_drag(const Findings& found, std::size_t i);
bool is_proportional(const Findings& found, std::size_t i);
/// Drag opposes the velocity (-1: acts along it) | proportional to the velocity
Features drag(const Findings& found);

/// Share of moving particles with at least one spring | springs contract when long (-1: expand) | linear | have a rest
/// length | equal at both ends
Features spring_law(const Findings& found);
/// Share of neighbours that are joined | springs between other particles | what is fixed: 1 an end (or both), 0
/// nothing, 2 another particle
Features chain_links(const Findings& found);

/// Offset on the grid from one end of a spring to the other.
struct Offset {
  int down, side;
};
/// The two directions of the family of springs that this column tests; empty for another column.
std::vector<Offset> family_of(const std::string& column);
/// Share of the expected springs found, for each of the family's two directions | location of the missing springs, for
/// each direction: 0 if none or all are missing; otherwise 1, plus 1 if each of them touches the last row, 2 the last
/// column, 4 the first row, 8 the first column.
Features cloth_family(const Findings& found, const std::vector<Offset>& family);
/// Share of springs that belong to a family | the other springs: 0 none, 1 from border to border, 2 elsewhere | rows
/// and columns recognised
Features cloth_others(const Findings& found);
/// Rest lengths relative to that of a structural spring: of shear springs, of flexion springs along rows and along
/// columns; 0 if there are none.
Features cloth_lengths(const Findings& found);
/// Number of fixed particles, as a share of two | they are corners, or symmetric on one border | share of fixed
/// particles at rest at the start
Features cloth_pins(const Findings& found);

}  // namespace coursework::classic
