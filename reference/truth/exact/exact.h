// Closed-form solutions of scenes, which are recognised by their terms and springs, not by name.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct ExactSolution {
  std::string formula;                // for the user
  std::function<State(double t)> at;  // s -> state
};

/// Closed form of the scene, or nullopt. Recognised scenes:
///   - rotation: every point turns about the z axis;
///   - one mass on one spring, with start, velocity, gravity and steady wind along it, with or without drag and a
///     dashpot: u = e^(-gamma t / 2) (A cos w t + B sin w t) about the hanging length, with gamma = (c_drag +
///     c_dashpot) / m, and its critical and overdamped forms;
///   - such a mass whose pin is moved along the spring (linear.h); refused at resonance without damping, and near it
///     unless the pin moves little, because the amplitude must stay below the length of the spring;
///   - springs and masses on a line, with at least one of them pinned, gravity and moved pins along the line, one drag
///     rate, and dashpots in proportion to the stiffness: normal modes, each of which is such an oscillator;
///   - one free particle under gravity and steady wind, with or without drag: v = v_inf + (v_0 - v_inf) e^(-gamma t);
///   - particles that fall vertically onto balls, with restitution: parabolas;
///   - particles at rest on balls or planes within the cone of friction;
///   - particles between perpendicular planes without friction, or over a single plane with friction along a straight
///     line: each coordinate falls and bounces independently;
///   - one particle that slides with friction over a ball, from a start with nonzero speed, until it flies off.
/// Springs follow Hooke's law and must never turn over; bounds that hold for all times ensure this.
std::optional<ExactSolution> exact_solution(const Scene& scene);

/// True if the model has no terms but those of the types `Allowed`.
template <class... Allowed>
bool has_only(const Model& model) {
  return std::all_of(model.terms.begin(), model.terms.end(),
                     [](const Term& t) { return (std::holds_alternative<Allowed>(t) || ...); });
}

/// Acceleration of gravity and steady wind (m/s^2); nullopt if there are gusts.
std::optional<Vec3> steady_acceleration(const Model& model);

std::optional<ExactSolution> normal_modes(const Scene& scene);
std::optional<ExactSolution> bounces(const Scene& scene);
std::optional<ExactSolution> held_by_friction(const Scene& scene);
std::optional<ExactSolution> between_planes(const Scene& scene);
std::optional<ExactSolution> slide_over_ball(const Scene& scene);

}  // namespace crosscheck
