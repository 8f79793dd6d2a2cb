// Stiff springs: types and functions of the five parts. Do not change this file: the grader uses its own copy.
#pragma once

#include <array>
#include <functional>
#include <vector>

using Vec3 = std::array<double, 3>;
using Matrix3 = std::array<Vec3, 3>;  // m[row][column]
using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;  // a[row][column]

/// A spring between particles `a` and `b`. With d = x_a - x_b and L = |d|, the force on `a` is -stiffness (L - rest) d
/// / L, and the force on `b` is the opposite.
struct Spring {
  int a, b;
  double stiffness, rest;  // N/m, m
};

struct System {
  std::vector<double> mass;  // kg
  std::vector<bool> fixed;   // these particles never move
  std::vector<Spring> springs;
  Vec3 gravity;  // m/s^2
  double drag;   // c in the force -c v on every particle, N s/m
};

struct State {
  std::vector<Vec3> x, v;  // m, m/s
};

enum class Rule { explicit_euler, trapezoidal, rk4, symplectic_euler, leapfrog, implicit_euler };

/// jacobian.cpp: the derivative dF_a/dx_a of a spring's force on its end `a`, at d = x_a - x_b. All zeros if d is zero.
Matrix3 spring_jacobian(const Vec3& d, double stiffness, double rest);

/// linear.cpp: the solution x of `a` x = `b`. Throws std::domain_error if `a` is singular (see the handout).
Vector solve(Matrix a, Vector b);

/// implicit_euler.cpp: the state after one linearised implicit Euler step of length h. Calls the two functions above.
State implicit_euler_step(const System& system, const State& state, double h);

/// limits.cpp: the largest step (s) at which the rule's solution of u'' = -omega^2 u - gamma u' does not grow.
/// HUGE_VAL if every step is stable, 0 if none is.
double largest_stable_step(Rule rule, double omega, double gamma);

/// choose.cpp: a stable step that divides the duration and, for u'' = -omega^2 u, keeps the error at the end of the
/// duration below the tolerance. 0 if the rule has no stable step.
double predicted_step(Rule rule, double omega, double duration, double tolerance);

/// choose.cpp: run(h) is the final state of a run with steps of h, by a rule of this order. Returns the step whose
/// error equals the tolerance; the error is estimated from two runs, one with h and one with h/2.
double measured_step(const std::function<Vector(double)>& run, int order, double h, double tolerance);
