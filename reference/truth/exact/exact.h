// Closed-form solutions, for scenes that have one. A scene is recognised by its terms and springs, not by its name.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct ExactSolution {
  std::string formula;                // for people
  std::function<State(double t)> at;  // s -> state
};

/// The closed form of a scene that is one of these, or nothing:
///   - rotation: every point turns about the z axis;
///   - one mass on one spring, with start, speed, gravity and steady wind along it, with or without drag and a dashpot:
///     u = e^(-gamma t / 2) (A cos w t + B sin w t) about the hanging length, gamma = (c_drag + c_dashpot) / m, and its
///     critical and overdamped forms;
///   - the same with its pin moved along it (linear.h). Refused where the amplitude is not bounded below the length of
///     the spring: at resonance without damping, and near it unless the pin moves little;
///   - springs and masses on a line, at least one of them pinned, gravity and moved pins along it, one drag rate, and
///     dashpots in proportion to the stiffness: normal modes, each of them such an oscillator;
///   - one free particle under gravity and steady wind, with or without drag: v = v_inf + (v_0 - v_inf) e^(-gamma t);
///   - particles that fall straight on balls, with restitution: parabolas;
///   - particles at rest on balls or planes within the cone of friction: they stay;
///   - particles between planes at right angles without friction, or over one with friction along a straight line: each
///     coordinate falls and bounces by itself;
///   - one particle that slides over a ball from a start with speed, with friction, until it flies off.
/// Springs follow Hooke's law and must never turn over: what is claimed is bounded for all times.
std::optional<ExactSolution> exact_solution(const Scene& scene);

// The closed forms by kind, and the tests by which their scenes are recognised.

/// True when the model has no terms but these.
template <class... Allowed>
bool has_only(const Model& model) {
  return std::all_of(model.terms.begin(), model.terms.end(),
                     [](const Term& t) { return (std::holds_alternative<Allowed>(t) || ...); });
}

/// The constant acceleration of gravity and steady wind (m/s^2), or nothing when the wind has gusts.
std::optional<Vec3> steady_acceleration(const Model& model);

std::optional<ExactSolution> normal_modes(const Scene& scene);
std::optional<ExactSolution> bounces(const Scene& scene);
std::optional<ExactSolution> held_by_friction(const Scene& scene);
std::optional<ExactSolution> between_planes(const Scene& scene);
std::optional<ExactSolution> slide_over_ball(const Scene& scene);

}  // namespace crosscheck
