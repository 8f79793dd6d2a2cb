// Rates of a model: its fastest vibration, which decides what step an explicit rule can take, and its drag.
#pragma once

#include <optional>

#include "mysim/model.h"

namespace crosscheck {

/// Largest omega (rad/s) of M v'' = -K v with the stiffness K of the state, pins held; 0 without springs. Power
/// iteration from a seeded start, to 1e-4 or 500 products: from below.
double fastest_frequency(const Model& model, const State& state);

/// The same with every spring stretched far: then it pulls across its line as it does along it, and no state is faster.
double stretched_frequency(const Model& model, const State& state);

/// The one drag rate gamma = c / m of all free particles (1/s), 0 without drag, or nothing when they differ.
std::optional<double> uniform_drag_rate(const Model& model);

}  // namespace crosscheck
