// Measures the properties that a stepper's row declares: order, stability on both sides of the limit, repeatability.
#pragma once

#include <Eigen/Dense>

#include <complex>

#include "mysim/eigenvalues.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

/// Coarse h omega for measuring orders: small enough for the leading error term to dominate, large enough to stay above
/// round-off.
inline double h_omega_for(int order) { return order == 1 ? 0.002 : order == 2 ? 0.04 : 0.3; }

/// Measured order between a step of at most h and half this step, from the largest RMS error over time.
inline double measured_order(const Stepper& s, const Scene& scene, const Trajectory& truth, double h, const Run& run) {
  const double used = time_grid({h, run.duration, run.samples}).h;
  const double coarse = sup_rms(trajectory_of(s, scene, {used, run.duration, run.samples}), truth);
  const double fine = sup_rms(trajectory_of(s, scene, {used / 2, run.duration, run.samples}), truth);
  EXPECT_GT(fine, 1e-13) << "the error is at round-off, so the slope would be noise";
  return slope(coarse, fine);
}

/// 1 kg at rest on a vertical spring of 1 m and omega^2 N/m, with drag. Has no spring and no gravity if omega is 0.
inline Scene hanging(double omega, double gamma) {
  Scene scene = shipped_scene("spring");
  std::erase_if(scene.model.terms, [&](const Term& t) {
    return std::holds_alternative<Springs>(t) || (omega == 0 && std::holds_alternative<Gravity>(t));
  });
  if (omega > 0) {
    scene.model.terms.emplace_back(Springs{{{0, 1, omega * omega, 1, Family::single}}});
    scene.start.x(1, 1) = -(1 + 9.81 / (omega * omega));
  }
  return gamma > 0 ? with_drag(scene, gamma) : scene;
}

/// A step as a matrix on (vertical offset, vertical velocity). Exact up to round-off, because the spring is linear
/// along its axis and offsets are too small to pass the anchor.
inline Eigen::Matrix2d step_matrix(const Stepper& s, double omega, double gamma, double h) {
  const Scene scene = hanging(omega, gamma);
  auto stepped = [&](double offset, double velocity) {
    System f(scene.model);
    State state = scene.start;
    state.x(1, 1) += offset;
    state.v(1, 1) += velocity;
    Workspace w(state);
    s.step(f, state, h, w);
    return Eigen::Vector2d(state.x(1, 1) - scene.start.x(1, 1), state.v(1, 1));
  };
  constexpr double unit = 1e-3;  // m
  const double speed = unit * std::max({omega, gamma, 1.0});
  const Eigen::Vector2d rest = stepped(0, 0);
  Eigen::Matrix2d m;
  m << (stepped(unit, 0) - rest) / unit, (stepped(0, speed) - rest) / speed;
  return m;
}

/// Spectral radius. Time is first rescaled by `rate`, so that the entries have similar magnitudes.
inline double spectral_radius(const Eigen::Matrix2d& m, double rate) {
  Eigen::Matrix2d scaled = m;
  scaled(0, 1) *= rate;
  scaled(1, 0) /= rate;
  return eigenvalues(scaled).cwiseAbs().maxCoeff();
}

/// Damped oscillators (rad/s, 1/s) for tests of the limits.
struct Oscillation {
  double omega, gamma;
};
inline constexpr Oscillation oscillations[] = {{10, 0}, {10, 2}, {10, 15}, {10, 20}, {10, 50}, {3, 0.1}, {40, 7}};

/// A step just above the limit. Chooses the less stable of two steps, because a composition with a backward substep is
/// unstable only in a window (1.2 % wide for suzuki4 at gamma = 5 omega). Returns a fixed step if the limit is 0.
inline double just_above(const Stepper& s, double omega, double gamma) {
  const double limit = s.limit(omega, gamma);
  auto radius = [&](double h) { return spectral_radius(step_matrix(s, omega, gamma, h), omega); };
  if (limit == 0) return 0.2 / omega;
  return radius(1.005 * limit) > radius(1.02 * limit) ? 1.005 * limit : 1.02 * limit;
}

/// One sentence with numbers for each measurement that contradicts the row; empty if the row is correct.
inline std::string contradiction(const Stepper& row) {
  const Stepper s = at_fixed_step(row);
  std::string found;

  // Order, on the pendulum with drag. The next error term is smaller by a factor of h omega.
  const Scene pendulum = with_drag(shipped_scene("pendulum"), 2);
  const double omega = std::sqrt(1000.0);
  const Run run{0, 1, 20};
  const Trajectory truth = trajectory_of(stepper("rk4"), pendulum, {0.005 / omega, run.duration, run.samples});
  const double order = measured_order(s, pendulum, truth, h_omega_for(s.order) / omega, run);
  if (!(std::abs(order - s.order) < 0.15))
    found += fmt::format("order {} is declared, {:.2f} was measured. ", s.order, order);

  // Stability: the step matrix has a spectral radius of at most 1 just below the limit, and above 1 just above it.
  for (const auto& [w, gamma] : oscillations) {
    const double limit = s.limit(w, gamma);
    auto radius = [&](double h) { return spectral_radius(step_matrix(s, w, gamma, h), w); };
    // Offsets of 1e-3 m are differences of lengths of about 1 m, so their relative error is some ulps divided by the
    // offset. Coincident eigenvalues are accurate only to the square root of this error. Solvers of implicit rules may
    // stop at 1e-10 of the forces.
    const double noise = s.evaluations == 0 ? 1e-6 : 1e-11;
    const double below = limit == 0 ? 0 : std::isinf(limit) ? 100 / w : 0.98 * limit;
    if (below > 0 && !(radius(below) <= 1 + noise))
      found += fmt::format("omega = {}, gamma = {}: h = {:.4g} s is unstable, within the limit of {:.4g} s. ", w, gamma,
                           below, limit);
    if (std::isinf(limit)) continue;
    const double above = just_above(s, w, gamma);
    if (!(radius(above) > 1 + noise))
      found += fmt::format("omega = {}, gamma = {}: h = {:.4g} s is stable, beyond the limit of {:.4g} s. ", w, gamma,
                           above, limit);
  }

  // Growth on `circle`: a first-order rule multiplies the radius by |R(i h)| in each step.
  if (s.first_order) {
    const std::span<const double> polynomial = limits::stability_polynomial(s.limit);
    if (polynomial.empty()) found += "a first-order rule needs a limit with a stability polynomial. ";
    const Scene circle = shipped_scene("circle");
    for (const double h : {0.01, 0.05, 0.3, 1.0}) {
      std::complex<double> r = 0;
      for (size_t i = polynomial.size(); i-- > 0;) r = r * std::complex<double>(0, h) + polynomial[i];
      constexpr int steps = 100;
      const Trajectory t = trajectory_of(s, circle, {h, steps * h, steps});
      double largest = 0;
      for (int i = 0; i < steps; ++i)
        largest = std::max(largest, std::abs(t.x[i + 1].norm() / t.x[i].norm() / std::abs(r) - 1));
      // each stage has a few roundings of half an ulp of the radius
      if (!(largest <= (8 + 4 * s.evaluations) * eps))
        found += fmt::format("h = {} on circle: the growth of the radius differs from {} by {:.2g}. ", h, std::abs(r),
                             largest);
    }
  }

  // repeatability
  const Run short_run{1e-3, 0.1, 10};
  if (!identical(trajectory_of(row, pendulum, short_run), trajectory_of(row, pendulum, short_run)))
    found += "two runs differ. ";
  return found;
}

}  // namespace crosscheck::testing_tools
