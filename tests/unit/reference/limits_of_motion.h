// Equilibria and limiting motions in closed form, for comparison with scenes.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "mysim/eigenvalues.h"
#include "mysim/model/system.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/exact/linear.h"

namespace crosscheck::testing_tools {

/// Period (s) of a rigid pendulum of length L (m) released at the angle theta0 (rad): 2 pi sqrt(L/g) / agm(1,
/// cos(theta0/2)), Gauss's form of the complete elliptic integral of the first kind. The limit of `pendulum` for k ->
/// infinity.
inline double rigid_pendulum_period(double length, double gravity, double theta0) {
  double a = 1, b = std::cos(theta0 / 2);
  while (std::abs(a - b) > 1e-15 * a) {  // quadratic convergence: four or five iterations
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * std::numbers::pi * std::sqrt(length / gravity) / a;
}

/// Equilibrium (3 x n, m) of a tree of Hooke's springs below a single pin, under gravity and steady wind: each spring
/// is extended by its load divided by its stiffness. The scene need not start there. Returns nullopt for other scenes.
inline std::optional<Points> hanging_equilibrium(const Scene& scene) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto* springs = model.find<Springs>();
  const auto a = steady_acceleration(model);
  const int n = particles.size();
  if (!springs || springs->law != SpringLaw::hooke || !a || !(a->norm() > 0) || particles.pins.size() != 1 ||
      particles.move || static_cast<int>(springs->list.size()) != n - 1 ||
      !has_only<Springs, Dashpots, Gravity, Wind, Drag>(model))
    return std::nullopt;
  std::vector<std::vector<const Spring*>> at(n);
  for (const Spring& s : springs->list) at[s.a].push_back(&s), at[s.b].push_back(&s);

  // Load of each particle, including its own weight, from the pin downwards. There are as many springs as free
  // particles, so each particle is reached once unless there is a loop, which leaves a particle unreached.
  std::vector<char> reached(n, 0);
  std::vector<double> carried(n, 0);  // kg
  std::vector<std::pair<const Spring*, int>> order;
  std::function<void(int)> descend = [&](int i) {
    reached[i] = 1;
    carried[i] = particles.mass[i];
    for (const Spring* s : at[i]) {
      const int below = s->a == i ? s->b : s->a;
      if (reached[below]) continue;
      order.emplace_back(s, below);
      descend(below);
      carried[i] += carried[below];
    }
  };
  descend(particles.pins[0]);
  if (std::ranges::count(reached, 1) != n) return std::nullopt;

  const Vec3 down = a->normalized();
  Points x = scene.start.x;
  for (const auto& [s, below] : order)
    x.col(below) = x.col(s->a + s->b - below) + (s->rest + carried[below] * a->norm() / s->k) * down;
  return x;
}

/// The limit of the motion for amplitudes towards 0. Unless all springs lie on one line, it is not an exact solution of
/// the scene. It is never claimed as one.
struct LinearisedSolution {
  std::vector<double> omega;          // rad/s, angular frequencies of the vibrations, ascending
  std::function<State(double t)> at;  // s -> state
};

/// Small motion of Hooke's springs under gravity, steady wind and one drag rate about an equilibrium (3 x n, m) near
/// the initial state. Returns nullopt if the positions are no equilibrium or an unstable one (an unstretched cloth has
/// no transverse stiffness, and a compressed one buckles), and for other scenes.
///
/// Neglected terms start with the square of the amplitude `a`. A flat cloth that moves out of its plane is symmetric in
/// up and down: out of the plane, the deviation divided by `a` decreases as a^2; in the plane, where nothing moves to
/// first order, it decreases as `a`. Motion in the plane has a relative error of first order in `a`.
/// Example: a cloth of 6 x 6 particles, held along its edge of 1 m, stretched by a tenth and released in its first
/// bump, deviates by 1 % within three periods from an amplitude of 11 mm out of the plane, or 8.8 mm in it.
inline std::optional<LinearisedSolution> linearised_solution(const Scene& scene, const Points& equilibrium) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto* springs = model.find<Springs>();
  const auto a = steady_acceleration(model);
  const auto drag = uniform_drag_rate(model);
  if (!springs || springs->law != SpringLaw::hooke || !a || !drag || particles.move ||
      !has_only<Springs, Gravity, Wind, Drag>(model))
    return std::nullopt;

  // each spring has stiffness k along its axis, and tension over length across it
  const int n = particles.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Points force = *a * particles.mass.transpose();
  double stiffness = 0;
  for (const Spring& s : springs->list) {
    const Vec3 d = equilibrium.col(s.a) - equilibrium.col(s.b);
    const double length = d.norm(), tension = s.k * (length - s.rest);
    if (!(length > 0)) return std::nullopt;
    const Vec3 along = d / length;
    const Eigen::Matrix3d block =
        tension / length * Eigen::Matrix3d::Identity() + (s.k - tension / length) * along * along.transpose();
    for (const int p : {s.a, s.b})
      for (const int q : {s.a, s.b}) k.block<3, 3>(3 * p, 3 * q) += p == q ? block : -block;
    force.col(s.a) -= tension * along;
    force.col(s.b) += tension * along;
    stiffness = std::max(stiffness, s.k);
  }
  for (int pin : particles.pins) force.col(pin).setZero();
  // the positions must be an equilibrium, up to the rounding of the written values
  if (!(largest_column(force) <= 1e-10 * stiffness * scene.size())) return std::nullopt;

  std::vector<int> free;  // coordinates
  for (int i = 0; i < n; ++i)
    if (!particles.pinned[i]) free.insert(free.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  Eigen::VectorXd mass(3 * n);
  for (int i = 0; i < n; ++i) mass.segment<3>(3 * i).setConstant(particles.mass[i]);
  const Eigen::VectorXd root = mass(free).cwiseSqrt();
  const Eigensystem vibrations =
      symmetric_eigensystem(root.cwiseInverse().asDiagonal() * k(free, free) * root.cwiseInverse().asDiagonal());
  const Eigen::VectorXd& omega2 = vibrations.values;
  if (!(omega2.minCoeff() > 1e-12 * omega2.maxCoeff())) return std::nullopt;  // slack or buckling
  const Points off = scene.start.x - equilibrium;
  const Eigen::MatrixXd to_modes = vibrations.vectors.transpose() * root.asDiagonal(),
                        shapes = root.cwiseInverse().asDiagonal() * vibrations.vectors;
  const Eigen::VectorXd u0 = to_modes * off.reshaped()(free), v0 = to_modes * scene.start.v.reshaped()(free);

  LinearisedSolution solution;
  std::vector<Oscillator> modes;
  for (int i = 0; i < omega2.size(); ++i) {
    solution.omega.push_back(std::sqrt(omega2[i]));
    modes.push_back({omega2[i], *drag, u0[i], v0[i]});
  }
  solution.at = [equilibrium, free, shapes, modes](double t) {
    Eigen::VectorXd u(modes.size()), v(modes.size());
    for (size_t i = 0; i < modes.size(); ++i)
      u[static_cast<int>(i)] = modes[i].position(t), v[static_cast<int>(i)] = modes[i].velocity(t);
    State s{t, equilibrium, Points::Zero(3, equilibrium.cols())};
    s.x.reshaped()(free) += shapes * u;
    s.v.reshaped()(free) += shapes * v;
    return s;
  };
  return solution;
}

}  // namespace crosscheck::testing_tools
