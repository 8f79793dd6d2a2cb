#pragma once

#include <optional>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// Finds a scene's state of rest (3 x n, m) from a guess, by Newton's method with Levenberg's damping (K. Levenberg,
/// 1944). Returns nullopt if the residual acceleration exceeds a ten-thousandth of gravity, or if the state is a saddle
/// (its stiffness matrix, with a billionth of the largest stiffness added, is not positive definite).
std::optional<Points> rest_near(const Scene& scene, const Points& guess);

}  // namespace crosscheck
