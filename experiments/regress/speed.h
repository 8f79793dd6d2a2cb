// How fast methods are, as ratios to a plain loop on the same scene in the same rounds.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/regress/questions.h"

namespace crosscheck {

/// One scene under one method, over its first steps; beside another method where one is named.
struct SpeedQuestion {
  Scene scene;
  Method method;
  std::optional<Method> against = {};
  Run run = {};
  std::string in_words() const;
};

/// Every scene asked under its own method, and, where that is all of the shipped ones, a cloth of 32 x 32 particles
/// under every method asked (all of mysim and Bullet): what the filter leaves of them. With `against`, those scenes
/// under the one method that is asked. What a program of its own does is not asked: it has a clock of its own. Empty
/// where nothing is left.
std::vector<SpeedQuestion> speed_questions(const Asked& asked, const std::optional<Method>& against);

/// How well is measured: so many rounds, in each of which every question has its turn.
struct SpeedPlan {
  int rounds;
  double resolution = 2e-3;  // s: shorter runs are repeated within a round until they have taken as much
};

/// CPU time of a method over that of as many steps of the plain loop, 1, of every round; empty where the run is refused
/// or fails.
struct Ratios {
  std::vector<double> is;   // of the method
  std::vector<double> was;  // of the one that it stands beside, in the same rounds; empty without one
};

/// How they are had: by measured_ratios(), or from a table of invented ones.
using Measure = std::function<std::vector<Ratios>(const std::vector<SpeedQuestion>&, const SpeedPlan&)>;

/// In each round each question is asked between two turns of the plain loop, so that a slow spell of the machine falls
/// on both, and with everything elsewhere in memory, as drawn from the seed: what that changes is noise, too.
std::vector<Ratios> measured_ratios(const std::vector<SpeedQuestion>& questions, const SpeedPlan& plan, int seed);

}  // namespace crosscheck
