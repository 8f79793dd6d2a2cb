// The table of steppers, and their stability limits.
#include "mysim/steppers/steppers.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <span>

#include "mysim/implicit/newton.h"

namespace crosscheck::limits {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// First h at which the growth of a step of h exceeds 1, by scanning and bisection; `scale` is a step much larger than
/// the result. Returns 0 if even the shortest steps grow.
template <class Growth>
double first_exit(Growth growth, double scale) {
  constexpr int walk = 4000;
  // 1e-13 exceeds rounding: the growth of neutral rules is exactly 1
  auto unstable = [&](double h) { return growth(h) > 1 + 1e-13; };
  if (!std::isfinite(scale)) return infinity;
  double low = 0;
  for (int i = 1; i <= walk; ++i) {
    double high = scale * i / walk;
    if (!unstable(high)) {
      low = high;
      continue;
    }
    for (int bisection = 0; bisection < 60; ++bisection) {
      const double middle = (low + high) / 2;
      (unstable(middle) ? high : low) = middle;
    }
    // a rule that is unstable at every step size, if only slightly, is already unstable at the first point
    return i == 1 ? 0 : low;
  }
  return infinity;
}

struct Eigenvalues {
  std::complex<double> slow, fast;  // 1/s
};
Eigenvalues eigenvalues_of(double omega, double gamma) {
  const std::complex<double> root = std::sqrt(std::complex<double>(gamma * gamma / 4 - omega * omega));
  return {-gamma / 2 + root, -gamma / 2 - root};
}

/// A Runge-Kutta rule multiplies each mode by its stability polynomial R(h lambda).
double runge_kutta(StabilityLimit rule, double omega, double gamma) {
  const std::span<const double> coefficients = stability_polynomial(rule);
  const auto [slow, fast] = eigenvalues_of(omega, gamma);
  auto size = [&](std::complex<double> z) {
    std::complex<double> sum = 0;
    for (size_t i = coefficients.size(); i-- > 0;) sum = sum * z + coefficients[i];
    return std::abs(sum);
  };
  const double fastest = std::max(std::abs(slow), std::abs(fast));
  if (fastest == 0) return infinity;
  return first_exit([&, slow = slow, fast = fast](double h) { return std::max(size(h * slow), size(h * fast)); },
                    8 / fastest);
}

/// The leapfrog step as a matrix on (u, v); h may be negative.
Eigen::Matrix2d leapfrog_matrix(double omega, double gamma, double h) {
  const double half = h * gamma / 2;
  Eigen::Matrix2d drift, kick;
  drift << 1, h / 2, 0, 1;
  kick << 1, 0, -h * omega * omega / (1 + half), (1 - half) / (1 + half);
  return drift * kick * drift;
}

double spectral_radius(const Eigen::Matrix2d& m) {
  const std::complex<double> half = m.trace() / 2, root = std::sqrt(half * half - m.determinant());
  return std::max(std::abs(half + root), std::abs(half - root));
}

}  // namespace

double explicit_euler(double omega, double gamma) {
  // at the limit |1 + h lambda| = 1; a complex pair has |lambda|^2 = omega^2 and Re lambda = -gamma/2, and for a real
  // pair the fast eigenvalue determines the limit
  if (gamma < 2 * omega) return gamma / (omega * omega);
  const double fast = (gamma + std::sqrt(gamma * gamma - 4 * omega * omega)) / 2;
  return fast > 0 ? 2 / fast : infinity;
}

double trapezoidal(double omega, double gamma) {
  if (gamma == 0) return omega > 0 ? 0 : infinity;  // |R|^2 = 1 + (h omega)^4 / 4
  return runge_kutta(trapezoidal, omega, gamma);
}

double rk4(double omega, double gamma) { return runge_kutta(rk4, omega, gamma); }

double dopri5(double omega, double gamma) { return runge_kutta(dopri5, omega, gamma); }

std::span<const double> stability_polynomial(StabilityLimit limit) {
  // up to the order of each rule, coefficients are those of the exponential
  static constexpr double coefficients[] = {1, 1, 1. / 2, 1. / 6, 1. / 24, 1. / 120, 1. / 600};
  const size_t count = limit == explicit_euler ? 2
                       : limit == trapezoidal  ? 3
                       : limit == rk4          ? 5
                       : limit == dopri5       ? 7
                                               : 0;
  return std::span(coefficients).first(count);
}

double symplectic_euler(double omega, double gamma) {
  // trace 2 - h gamma - (h omega)^2, determinant 1 - h gamma: stable as long as trace > -1 - determinant
  const double sum = gamma + std::sqrt(gamma * gamma + 4 * omega * omega);
  return sum > 0 ? 4 / sum : infinity;
}

double leapfrog(double omega, double) { return omega > 0 ? 2 / omega : infinity; }

double suzuki4(double omega, double gamma) {
  const double p = 1 / (4 - std::cbrt(4.0)), fastest = std::max(omega, gamma);
  if (fastest == 0) return infinity;
  return first_exit(
      [&](double h) {
        const Eigen::Matrix2d outer = leapfrog_matrix(omega, gamma, p * h);
        return spectral_radius(outer * outer * leapfrog_matrix(omega, gamma, (1 - 4 * p) * h) * outer * outer);
      },
      8 / fastest);
}

double none(double, double) { return infinity; }

}  // namespace crosscheck::limits

namespace crosscheck {

std::span<const Stepper> steppers() {
  static constexpr Stepper table[] = {
      {.name = "explicit-euler",
       .step = explicit_euler,
       .order = 1,
       .evaluations = 1,
       .first_order = true,
       .symplectic = false,
       .limit = limits::explicit_euler,
       .limit_formula = "h < gamma / omega^2 (2 / lambda_max when overdamped); never stable without drag",
       .what = "forward Euler, a cautionary example"},
      {.name = "trapezoidal",
       .step = trapezoidal,
       .order = 2,
       .evaluations = 2,
       .first_order = true,
       .symplectic = false,
       .limit = limits::trapezoidal,
       .limit_formula = "|1 + z + z^2/2| < 1 at z = h lambda; never stable without drag",
       .what = "explicit trapezoidal rule (Heun), the assignment's second rule"},
      {.name = "rk4",
       .step = rk4,
       .order = 4,
       .evaluations = 4,
       .first_order = true,
       .symplectic = false,
       .limit = limits::rk4,
       .limit_formula = "h omega < 2.83 without drag",
       .what = "classic Runge-Kutta: accurate for smooth motion; reference solutions by step halving"},
      {.name = "symplectic-euler",
       .step = symplectic_euler,
       .order = 1,
       .evaluations = 1,
       .first_order = false,
       .symplectic = true,
       .limit = limits::symplectic_euler,
       .limit_formula = "h < 4 / (gamma + sqrt(gamma^2 + 4 omega^2)): h omega < 2 without drag",
       .what = "kick, then drift; the rule of Bullet's explicit deformable world",
       .composition = symplectic_euler_composition},
      {.name = "leapfrog",
       .step = leapfrog,
       .order = 2,
       .evaluations = 1,
       .first_order = false,
       .symplectic = true,
       .limit = limits::leapfrog,
       .limit_formula = "h omega < 2 for any drag",
       .what = "half drift, kick, half drift; best accuracy at one evaluation per step",
       .composition = leapfrog_composition},
      {.name = "suzuki4",
       .step = suzuki4,
       .order = 4,
       .evaluations = 5,
       .first_order = false,
       .symplectic = true,
       .limit = limits::suzuki4,
       .limit_formula = "h omega < 2.72 without drag; h gamma < 3.02 without springs",
       .what = "five leapfrogs; more accurate than rk4 at equal work, with bounded energy error",
       .composition = suzuki4_composition},
      {.name = "dopri5",
       .step = dopri5,
       .order = 5,
       .evaluations = 6,
       .first_order = true,
       .symplectic = false,
       .limit = limits::dopri5,
       .limit_formula = "steps follow the tolerance; at a fixed step: h omega < 1.0 without drag",
       .what = "Dormand-Prince 5(4) with error control and dense output: give --tol, not --step; with contact, its "
               "steps are at most the scene's, because contact acts on whole steps",
       .adaptive = true},
      {.name = "implicit-euler",
       .step = implicit_euler,
       .order = 1,
       .evaluations = 0,
       .first_order = false,
       .symplectic = false,
       .limit = limits::none,
       .limit_formula = "stable at every step",
       .what = "Newton's method on the whole nonlinear step; stiff springs at large steps, at the cost of damping; "
               "+linear: one Newton step, the rule of Bullet's implicit world",
       .solved_to = force_tolerance,
       .linear = implicit_euler_linear},
      {.name = "implicit-midpoint",
       .step = implicit_midpoint,
       .order = 2,
       .evaluations = 0,
       .first_order = false,
       .symplectic = true,
       .limit = limits::none,
       .limit_formula = "stable at every step on linear springs",
       .what = "symplectic and implicit: keeps the energy of linear springs at any step",
       .solved_to = force_tolerance},
      {.name = "xpbd",
       .step = xpbd,
       .order = 1,
       .evaluations = 2,
       .first_order = false,
       .symplectic = false,
       .limit = limits::none,
       .limit_formula = "stable at every step on one spring",
       .what = "extended position-based dynamics, springs of compliance 1/k, swept once per step; the only rule here "
               "that supports hard distances",
       .hard_constraints = true},
  };
  static_assert(std::all_of(std::begin(table), std::end(table), [](const Stepper& s) {
    return std::count_if(std::begin(table), std::end(table), [&](const Stepper& t) { return t.name == s.name; }) == 1;
  }));
  return table;
}

}  // namespace crosscheck
