// Methods timed in turns, over as much of a run as the clock needs.
#pragma once

#include <memory>
#include <optional>

#include "experiments/bench/instructions.h"
#include "reference/method.h"

namespace crosscheck {

/// One run of a method on a scene; mysim's fast paths keep to an instruction set where one is named.
struct Turn {
  Method method;
  std::shared_ptr<const Scene> scene;
  Run run;
  std::optional<strip::Isa> instructions = {};
};

struct TurnTimes {
  std::vector<double> per_evaluation;  // s, one for each round
  double share = 1;                    // of the run that is timed
};

struct TurnPlan {
  int rounds = 11;
  double seconds = 0.02;  // of each run in each round
};

/// CPU time of each run over its evaluations, nobody looking on: without contact each evaluation costs the same, so
/// that the first part of a run tells the time of the whole. In a round all have their turn. A run that tells no time
/// or fails at once has no times.
std::vector<TurnTimes> timed_in_turns(const std::vector<Turn>& turns, const TurnPlan& plan);

}  // namespace crosscheck
