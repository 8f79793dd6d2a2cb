// Numerical damping: what a rule takes from an oscillation that nothing damps.
#pragma once

#include <optional>
#include <string>

#include "experiments/point.h"
#include "reference/method.h"

namespace crosscheck {

/// 1 kg on a spring of 100 N/m (omega = 10 rad/s) without gravity or drag, let go 1 mm off its length.
Scene undamped_oscillator();

/// The drag rate (1/s) that a rule's damping of an oscillation amounts to, at h omega per step: -2 ln|R(i h omega)| / h
/// with its stability function R; 0 of symplectic rules. Negative where energy is made. Empty for rules without one.
std::optional<double> damping_by_theory(const Method& method, double h, double omega);

/// The same from a run of `steps` steps: minus the slope of ln(energy) over time, least squares. Empty where the method
/// does not take the scene.
struct MeasuredDamping {
  Outcome outcome;
  std::optional<double> rate;  // 1/s
};
MeasuredDamping measured_damping(const Method& method, double h, int steps);

/// Table energy-damping: both, over a range of steps, for every method with fixed steps.
void add_damping(const Method& method, bool full, Rows& rows);

}  // namespace crosscheck
