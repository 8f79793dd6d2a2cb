// Exact results of one-step rules on linear scenes: powers of its amplification matrix. Written from the
// rules' definitions, apart from mysim's steppers, which are tested against it.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string_view>

#include "reference/truth/exact/linear.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The increment of (u, v, 1) in a step, as a matrix E: the rule multiplies by I + E. Kept without the identity, next
/// to which the small entries of short steps would lose their digits.
using Increment = Eigen::Matrix3d;

struct DiscreteStepper {
  std::string_view name;                                       // of mysim's stepper
  Increment (*of_mode)(const Mode& mode, double h);            // moved pins left out
  Increment (*of_system)(const Eigen::Matrix3d& a, double h);  // of y' = A y; null where the rule needs u'' = ...
  bool one_spring = false;                                     // projects the springs one by one: a matrix for one only
};

/// The table: every one-step rule of mysim's. dopri5 chooses its steps and has none.
std::span<const DiscreteStepper> discrete_steppers();

/// (I + E)^n - I by repeated squaring, 2 E + E^2: exact but for relative roundings of about log2(n), and of n times the
/// phase of a step.
Increment increment_power(Increment e, long n);

/// The rule's solution of a linear scene (reference/truth/exact/linear.h, pins at rest) or of a rotation, at the
/// samples. The bar is what rounding may do to a run of it: n steps, each of which rounds positions by 4 eps |x| and
/// velocities by 4 eps (|v| + h sum(k) / m |x|), an error in velocity moving positions by 1 / omega of the slowest mode
/// (or by the duration, if less), times the growth of errors under the rule. Throws Unsupported where the scene is not
/// linear, where springs would turn over (looked for at the samples, with each mode's amplitude there), and where the
/// rule is no matrix.
Truth discrete_truth(const DiscreteStepper& rule, const Scene& scene, const Run& run);

}  // namespace crosscheck
