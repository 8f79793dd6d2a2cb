// Exact results of one-step rules on linear scenes by powers of amplification matrices, written from the rules'
// definitions. Steppers are tested against them.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string_view>

#include "reference/truth/exact/linear.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Increment of (u, v, 1) in a step, as a matrix E: the rule multiplies by I + E. The identity is left out, because
/// the small entries of short steps would lose their digits in the sum.
using Increment = Eigen::Matrix3d;

struct DiscreteStepper {
  std::string_view name;                                       // mysim's stepper
  Increment (*of_mode)(const Mode& mode, double h);            // without moved pins
  Increment (*of_system)(const Eigen::Matrix3d& a, double h);  // for y' = A y; null if the rule needs u'' = ...
  bool one_spring = false;                                     // projects springs one by one: supports one spring only
};

/// Every one-step rule of mysim except dopri5, which chooses its steps.
std::span<const DiscreteStepper> discrete_steppers();

/// (I + E)^n - I by repeated squaring, 2 E + E^2. The relative rounding error, in ulps, is about log2(n) plus n times
/// the phase (rad) of a step.
Increment increment_power(Increment e, long n);

/// The rule's solution of a linear scene (reference/truth/exact/linear.h, pins at rest) or of a rotation, at the
/// samples. The error bar bounds the effect of rounding on a run of the rule. Each of the n steps rounds positions by 4
/// eps |x| and velocities by 4 eps (|v| + h sum(k) / m |x|). An error in velocity moves a position by this error times
/// 1 / omega of the slowest mode, or times the duration if that is less. Both errors are multiplied by the growth of
/// errors under the rule. Throws Unsupported if the scene is not linear, if springs would turn over (checked at the
/// samples, with each mode's amplitude there), or if the rule is not a matrix.
Truth discrete_truth(const DiscreteStepper& rule, const Scene& scene, const Run& run);

}  // namespace crosscheck
