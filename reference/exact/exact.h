// Closed-form solutions, for scenes that have one. A scene is recognised by what it is made of, not by its name.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mysim/scene.h"

namespace crosscheck {

struct ExactSolution {
  std::string formula;                // for people
  std::function<State(double t)> at;  // s -> state
};

/// The closed form of a scene that is one of these, or nothing:
///   - rotation: every point turns about the z axis;
///   - one mass on one vertical spring (start, velocity and gravity along it, never reaching the anchor), with or
///   without
///     drag: y = y_eq + e^(-gamma t / 2) (A cos w t + B sin w t), and its critical and overdamped forms;
///   - one free particle under gravity and steady wind, with or without drag: v = v_inf + (v_0 - v_inf) e^(-gamma t);
///   - springs and masses on a line, at least one of them pinned, none of which reaches its neighbour: normal modes;
///   - particles that fall straight on balls, with restitution: parabolas;
///   - one particle that slides over a ball from a start with speed, with friction, until it flies off.
std::optional<ExactSolution> exact_solution(const Scene& scene);

/// Period of a rigid pendulum of length L (m) let go at the angle theta0 (rad), s: 2 pi sqrt(L/g) / agm(1,
/// cos(theta0/2)), which is the complete elliptic integral of the first kind in Gauss's form. The limit of `pendulum`
/// for k -> infinity.
double rigid_pendulum_period(double length, double gravity, double theta0);

}  // namespace crosscheck
