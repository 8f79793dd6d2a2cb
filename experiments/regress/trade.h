// What a change of speed was bought with, or paid for: its speed and its accuracy on one line.
#pragma once

#include <span>

#include "experiments/regress/speed_verdict.h"
#include "experiments/regress/verdicts.h"

namespace crosscheck {

/// "buys speed with accuracy: 1.4 times faster, error against truth 2.3 times larger". From the quantities of the same
/// scene and method; of a scene that has none (the cloth that is there for its size) from all scenes of that method.
/// Empty where the speed did not change.
std::string trade_of(const SpeedCompared& speed, std::span<const Compared> answers);

/// Sets the sentence of every row, and returns those there are: "chain under mysim/rk4: faster at the same answer".
std::vector<std::string> tell_trades(std::vector<SpeedCompared>& speeds, std::span<const Compared> answers);

}  // namespace crosscheck
