// Attribution of changes: the ingredient or stepper that all failures share; the accuracy that a change of speed was
// bought with.
#pragma once

#include <span>

#include "experiments/regress/comparison.h"
#include "experiments/regress/speed_regression.h"

namespace crosscheck {

// The ingredient or the rule that the failures have in common.

/// In words for people; empty where it is not attributed. Settings that the engine reports are named where they changed
/// in every case that moved. An ingredient is named only where
///   every case that moved has it,
///   taking it out makes the difference vanish, wherever that is a case and moved before,
///   every shipped scene that has it moved (under the methods that moved),
/// and no other ingredient fits as well. Rules, three at most, are named where nothing but they moved, and where each
/// scene that moved under them was run under another rule and did not. Cases whose run was refused or failed
/// before say nothing. What fits neither way is not attributed.
std::string attribution_of(std::span<const Case> cases, std::span<const Comparison> rows);

// A change of speed and the change of accuracy that came with it, in one line.

/// "buys speed with accuracy: 1.4 times faster, error against truth 2.3 times larger". From the quantities of the same
/// scene and method; of a scene that has none (the cloth that is there for its size) from all scenes of that method.
/// Empty where the speed did not change.
std::string speed_accuracy_of(const SpeedComparison& speed, std::span<const Comparison> quantities);

/// Sets the sentence of every row, and returns those there are: "chain under mysim/rk4: faster at the same result".
std::vector<std::string> explain_speeds(std::vector<SpeedComparison>& speeds, std::span<const Comparison> quantities);

}  // namespace crosscheck
