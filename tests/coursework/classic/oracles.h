// What of a probe's raw numbers (probe/forces.h) is right whatever constants a student chose: shares, signs, shapes.
// Runs in the grader alone; the student's process only returns numbers.
#pragma once

#include <vector>

#include "tests/coursework/check/case.h"

namespace coursework::classic {

/// A number, or a share with how many all are.
struct Feature {
  double got, of = 0;
  Feature(double number, double all = 0) : got(number), of(all) {}
};
using Features = std::vector<Feature>;

/// 0 where there is nothing to look at.
Feature share(int good, int all);

/// entries of evalF per entry of the state | asked twice | stored state kept | the state given counts
Features purity(const Numbers& raw);
/// of `wanted` particles those that there are | x' = v, or 0 of those that are fixed | how many are fixed | those of
/// them that are at rest when it starts, so that x' = v moves them nowhere
Features motion(const Numbers& raw, int wanted);
/// gravity downwards on those that move (-1: upwards) | the same for all
Features gravity(const Numbers& raw);
/// drag against the velocity (-1: along) | in proportion to it
Features drag(const Numbers& raw);

/// joined: each particle that moves hangs on a spring | draws together when long (-1: drives apart) | linear |
/// has a rest length | the same from both ends
Features spring_law(const Numbers& raw);
/// neighbours joined | springs between others | fixed: 1 an end (or both), 0 none, 2 another
Features chain_links(const Numbers& raw);

struct Family {
  int down, side;
};
/// Springs found of those that there should be, for a family along each of its two directions | where the others are
/// that should be, along each: 0 there are none, or all are missing; else 1, and 1 more where each of them touches the
/// last row, 2 the last column, 4 the first row, 8 the first column.
Features cloth_family(const Numbers& raw, Family a, Family b);
/// Springs that are of a family | the others: 0 there are none, 1 from border to border, 2 elsewhere | rows and columns
/// recognised
Features cloth_others(const Numbers& raw);
/// Rest lengths, relative to a structural spring's: of shear, of flexion along rows and along columns; 0: there is
/// none.
Features cloth_lengths(const Numbers& raw);
/// Particles that are fixed, of the two at least | they are corners, or lie evenly on one border | those that are at
/// rest when it starts
Features cloth_pins(const Numbers& raw);

}  // namespace coursework::classic
