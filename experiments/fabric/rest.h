// Where a scene comes to rest, found from a guess without the motion there.
#pragma once

#include <optional>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The scene's state of rest (3 x n, m) that Newton's method, kept downhill (K. Levenberg, 1944), finds from a guess;
/// nothing where it does not get to a ten-thousandth of gravity, or ends at a saddle: with a billionth of the largest
/// stiffness added, that of the state is positive definite.
std::optional<Points> rest_near(const Scene& scene, const Points& guess);

}  // namespace crosscheck
