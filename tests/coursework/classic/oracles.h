// What of a probe's raw numbers (probe/forces.h) is right whatever constants a student chose: shares, signs, shapes.
// Runs in the grader alone; the student's process only returns numbers.
#pragma once

#include "tests/coursework/check/case.h"

namespace coursework::classic {

/// 1: all, 0: none (or nothing to look at), 0.5: some.
double share(int good, int all);

/// entries of evalF per entry of the state | asked twice | stored state kept | the state given counts
Numbers purity(const Numbers& raw);
/// enough particles (0.5: fewer than `wanted`) | x' = v of those that move | particles that are fixed: 0, 1 some, 2 all
Numbers motion(const Numbers& raw, int wanted);
/// gravity downwards on those that move (-1: upwards) | the same for all
Numbers gravity(const Numbers& raw);
/// drag against the velocity (-1: along) | in proportion to it
Numbers drag(const Numbers& raw);

/// joined: each particle that moves hangs on a spring | draws together when long (-1: drives apart) | linear |
/// has a rest length | the same from both ends
Numbers spring_law(const Numbers& raw);
/// neighbours joined | springs between others: 0 none, 1 | fixed: 1 an end (or both), 0 none, 2 another
Numbers chain_links(const Numbers& raw);

struct Family {
  int down, side;
};
/// Springs found of those that there should be, for a family along each of its two directions.
Numbers cloth_family(const Numbers& raw, Family a, Family b);
/// Springs of no family: 0 none, 1 from border to border, 2 elsewhere | rows and columns recognised
Numbers cloth_others(const Numbers& raw);
/// Rest lengths, relative to a structural spring's, nearest of 1, 1.41, 2: of shear, of flexion | the pins are corners
/// or lie evenly on one border
Numbers cloth_lengths(const Numbers& raw);
Numbers cloth_pins(const Numbers& raw);

}  // namespace coursework::classic
