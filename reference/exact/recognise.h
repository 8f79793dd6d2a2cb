// Recognising what a scene is made of, for its closed form; and the closed forms by kind.
#pragma once

#include <algorithm>

#include "reference/exact/exact.h"

namespace crosscheck {

/// True when the model has no terms but these.
template <class... Allowed>
bool only(const Model& model) {
  return std::all_of(model.terms.begin(), model.terms.end(),
                     [](const Term& t) { return (std::holds_alternative<Allowed>(t) || ...); });
}

/// The constant acceleration of gravity and steady wind (m/s^2), or nothing when the wind has gusts.
std::optional<Vec3> steady_acceleration(const Model& model);

std::optional<ExactSolution> normal_modes(const Scene& scene);
std::optional<ExactSolution> bounces(const Scene& scene);
std::optional<ExactSolution> friction_hold(const Scene& scene);
std::optional<ExactSolution> slide_over_ball(const Scene& scene);

}  // namespace crosscheck
