// Judges a probe's findings (probe/findings.h) by what holds for any constants: shares, signs, shapes.
// Runs in the grader alone; the student's process only returns numbers.
#pragma once

#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

using probe::Findings;

/// A number, or a share with how many all are.
struct Feature {
  double got, of = 0;
  Feature(double number, double all = 0) : got(number), of(all) {}
};
using Features = std::vector<Feature>;

/// 0 where there is nothing to look at.
Feature share(int good, int all);

/// entries of evalF per entry of the state | asked twice | stored state kept | the state given counts
Features purity(const Findings& found);
/// of `wanted` particles those that there are | x' = v, or 0 of those that are fixed | how many are fixed | those of
/// them that are at rest when it starts, so that x' = v moves them nowhere
Features motion(const Findings& found, int wanted);
/// gravity downwards on those that move (-1: upwards) | the same for all
Features gravity(const Findings& found);
/// m/s^2 downwards on particle i, the middle of the draws; 1/s, what a velocity takes of itself in row i, below 0 where
/// it adds; whether any of these entries is not zero.
double gravity_on(const Findings& found, std::size_t i);
double drag_on(const Findings& found, std::size_t i);
bool is_free(const Findings& found, std::size_t i, std::size_t first, std::size_t last);
/// drag against the velocity (-1: along) | in proportion to it
Features drag(const Findings& found);

/// joined: each particle that moves hangs on a spring | draws together when long (-1: drives apart) | linear |
/// has a rest length | the same from both ends
Features spring_law(const Findings& found);
/// neighbours joined | springs between others | fixed: 1 an end (or both), 0 none, 2 another
Features chain_links(const Findings& found);

struct Family {
  int down, side;
};
/// Springs found of those that there should be, for a family along each of its two directions | where the others are
/// that should be, along each: 0 there are none, or all are missing; else 1, and 1 more where each of them touches the
/// last row, 2 the last column, 4 the first row, 8 the first column.
Features cloth_family(const Findings& found, Family a, Family b);
/// Springs that are of a family | the others: 0 there are none, 1 from border to border, 2 elsewhere | rows and columns
/// recognised
Features cloth_others(const Findings& found);
/// Rest lengths, relative to a structural spring's: of shear, of flexion along rows and along columns; 0: there is
/// none.
Features cloth_lengths(const Findings& found);
/// Particles that are fixed, of the two at least | they are corners, or lie evenly on one border | those that are at
/// rest when it starts
Features cloth_pins(const Findings& found);

}  // namespace coursework::classic
