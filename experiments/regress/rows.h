// What the table of quantities is made of.
#pragma once

#include "experiments/regress/answer.h"
#include "reference/truth.h"

namespace crosscheck {

struct Seen {
  const Question& question;
  const Answered& answered;
  const Scene& scene() const { return question.scene; }
  const Trajectory& path() const { return answered.trajectory; }
};
using Quantities = std::vector<Quantity>;

/// The truth over the scene's run where it has a closed form, else nothing: a converged one takes minutes to find.
std::optional<Truth> exact_truth(const Scene& scene);

/// How high particles rise above a ball after they first touched it, m.
void rebound_height(const Seen& seen, Quantities& out);

/// log2 of the error against the closed form over that at half the step, where there is one: near the rule's order.
/// One more run. Where the error is below 1e-10 of the scene's size it says nothing, and is left out.
void order_of_error(const Seen& seen, Quantities& out);

/// s, by bisection from rest, known to 0.2 %: on scenes of at most 12 free coordinates, of rules with a finite limit.
/// About 25 runs of 4000 steps.
void largest_stable_step(const Seen& seen, Quantities& out);

}  // namespace crosscheck
