// Calls that each of the three steppers answers. All begin with n, steps, t, h, x (n), followed by the numbers of the
// system:
//   PART.linear   A (n x n, by rows), b (n), c (n): x' = A x + b + c t    a row per step: x
//   PART.circle   omega; n is 2: x' = omega (-y, x)                       a row per step: x, y, |X| after / |X| before
//   PART.cosine   a, w, p (n each): x_i' = a_i cos(w_i t + p_i)           a row per step: x
//   PART.halved   r, w, p (n each): x_i' = r_i (1 + cos(w_i t + p_i) / 2) x_i (1 - x_i)
//                                   a row per step: x of a run with steps of h, then x of a second run with steps
//                                   of h/2, both at this step's end
//   PART.points   as linear, one step                                     a row per call of f: t, x
//   PART.twice    as linear, one step                                     rows: x(t + h); the argument x afterwards;
//                                   x(t + h) again, after a step with other numbers
#pragma once

#include <string>

#include "case.h"
#include "steppers.h"

namespace coursework {

using Stepper = State (*)(const Derivative& f, double t, const State& x, double h);

/// Answers the calls PART.*; returns false for calls of other parts.
bool answer_stepper(const std::string& part, Stepper step, const std::string& call, const Numbers& in, Numbers& out);

}  // namespace coursework
