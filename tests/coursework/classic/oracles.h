// Judges a probe's findings (probe/findings.h) by properties that hold for any constants: shares, signs, shapes. Runs
// only in the grader; the student's process only returns numbers.
#pragma once

#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

using probe::Findings;

/// Recomputes the findings of probe/forces.h from the answers of evalF that the student's process recorded; states and
/// questions are drawn again, and none are taken from that process. `answers` is a record in the format of probe/ask.h,
/// possibly forged; empty findings if it is malformed.
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

/// Entries of evalF per entry of the state | deterministic | stored state unchanged | depends on the argument instead
/// of the stored state
Features purity(const Findings& found);
/// Particles that exist of `wanted` | x' = v, or 0 for the fixed ones | number of fixed particles | fixed particles at
/// rest at the start, for which x' = v implies no motion
Features motion(const Findings& found, int wanted);
/// Gravity downwards on the moving particles (-1: upwards) | equal for all
Features gravity(const Findings& found);
/// gravity_on: downward acceleration of particle i (m/s^2), the median of the draws. drag_on: rate (1/s) at which a
/// velocity decays in row i, negative if it grows. is_free: true if any of entries `first` to `last` of particle i is
/// nonzero.
double gravity_on(const Findings& found, std::size_t i);
double drag_on(const Findings& found, std::size_t i);
bool is_free(const Findings& found, std::size_t i, std::size_t first, std::size_t last);
/// Drag opposes the velocity (-1: along it) | proportional to it
Features drag(const Findings& found);

/// Moving particles with at least one spring | contracts when long (-1: expands) | linear | has a rest length | equal
/// at both ends
Features spring_law(const Findings& found);
/// Neighbours joined | springs between others | fixed: 1 an end (or both), 0 none, 2 another particle
Features chain_links(const Findings& found);

/// Offset on the grid from one end of a spring to the other.
struct Offset {
  int down, side;
};
/// The two directions of the family of springs that this column tests; empty for another column.
std::vector<Offset> family_of(const std::string& column);
/// Shares of the expected springs found, for a family along each of its two directions | location of the missing
/// springs, along each: 0 if none or all are missing; otherwise 1, plus 1 if each of them touches the last row, 2 the
/// last column, 4 the first row, 8 the first column.
Features cloth_family(const Findings& found, const std::vector<Offset>& family);
/// Springs that belong to a family | the others: 0 none, 1 from border to border, 2 elsewhere | rows and columns
/// recognised
Features cloth_others(const Findings& found);
/// Rest lengths relative to that of a structural spring: of shear, of flexion along rows and along columns; 0 if there
/// is none.
Features cloth_lengths(const Findings& found);
/// Fixed particles out of at least two | they are corners, or evenly spaced on one border | fixed particles at rest at
/// the start
Features cloth_pins(const Findings& found);

}  // namespace coursework::classic
