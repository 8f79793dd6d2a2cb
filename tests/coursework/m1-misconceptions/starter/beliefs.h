// Five common beliefs, tested with numbers: shared by the parts. Do not change this file: the grader uses its own copy.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

// ---- kick_drift.cpp: a particle on a spring, x'' = -omega^2 x

struct Swing {
  double x, v;  // m, m/s
};

/// Explicit Euler: both the kick (v) and the drift (x) use the numbers at the start of the step.
Swing explicit_step(double omega, Swing now, double h);

/// Semi-implicit Euler: first the kick, then the drift with the new velocity.
Swing semi_implicit_step(double omega, Swing now, double h);

/// The quantity (m^2/s^2) that semi-implicit Euler conserves exactly with this step; for h = 0, the energy per mass.
double kept(double omega, Swing now, double h);

// ---- verlet.cpp

/// Position Verlet: the position h later, from the last two positions and the acceleration (m/s^2) at `now`.
double verlet_next(double before, double now, double acceleration, double h);

/// The order of a rule, from a list of its errors: each error is measured with half the step of the previous one.
double observed_order(const std::vector<double>& errors);

/// `error` is position Verlet's error after a fixed time. Returns its error after the same time with a step that is
/// `times_smaller` times smaller.
double predicted_error(double error, double times_smaller);

// ---- sag.cpp: how far the middle hangs below two ends at the same height, m, to a billionth of the length

/// An inextensible chain of this length under its own weight.
double catenary_sag(double length, double span);

/// An inextensible cable of this length under a load that is uniform along the span, such as a bridge.
double parabola_sag(double length, double span);

/// An elastic chain. `length`: unstretched length; `weight`: N per metre of unstretched length. A tension T (N)
/// stretches each metre to 1 + T / stiffness.
double elastic_sag(double length, double span, double weight, double stiffness);

/// The number between a millionth and a million at which f is 0. f must have different signs at these two limits.
template <class Function>
double root_of(const Function& f) {
  double low = 1e-6, high = 1e6;
  const bool rises = f(high) > 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(low * high);  // halves the remaining range of digits
    ((f(middle) > 0) == rises ? high : low) = middle;
  }
  return high;
}

// ---- iterations.cpp: particles on a vertical line; each hangs on a spring from the previous one, the first from the
// ceiling

struct Chain {
  double mass, stiffness, rest, gravity;  // kg, N/m, m, m/s^2
};

struct Line {
  std::vector<double> x, v;  // depth below the ceiling in m, downward speed in m/s
};

/// How a frame of the film is computed: `steps` steps with `iterations` iterations each.
struct Plan {
  int steps, iterations;
};

/// One iteration of extended position-based dynamics: visits the springs once, from the top, and moves the two
/// particles of each. `pulls` has a number for each spring, which is 0 before the first iteration of a step of h.
inline void iterate(const Chain& chain, double h, std::vector<double>& x, std::vector<double>& pulls) {
  const double softness = 1 / (chain.stiffness * h * h);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double above = i > 0 ? x[i - 1] : 0, mobility = (i > 0 ? 2 : 1) / chain.mass;
    const double stretch = x[i] - above - chain.rest;
    const double change = (-stretch - softness * pulls[i]) / (mobility + softness);
    pulls[i] += change;
    x[i] += change / chain.mass;
    if (i > 0) x[i - 1] -= change / chain.mass;
  }
}

/// The state of the chain one frame later, computed according to the plan.
Line advance(const Chain& chain, Line line, double frame, Plan plan);

/// A film of a chain whose true motion is known.
class Film {
 public:
  virtual ~Film() = default;
  /// Measures the largest error (m) if all frames are computed according to this plan.
  virtual double error(Plan plan) const = 0;
};

/// The plan with the smallest error among those whose steps times iterations equal the budget. Measures no other plans.
Plan choose(const Film& film, int budget);

// ---- rk4.cpp: the particle on a spring of kick_drift.cpp

/// One step of the classic Runge-Kutta rule of order four.
Swing rk4_step(double omega, Swing now, double h);

/// Factor by which one step multiplies the energy; `angle` is h omega.
double rk4_energy_factor(double angle);

/// The largest step (s) at which the rule gains no energy.
double rk4_largest_step(double omega);
