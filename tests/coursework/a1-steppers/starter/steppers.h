// Time steppers: each takes a state from t to t + h. Do not change this file: the grader uses its own copy.
#pragma once

#include <functional>
#include <vector>

/// The numbers X of a system at one moment. How many there are depends on the system: 1, 2, 8, a thousand.
using State = std::vector<double>;

/// The right-hand side of X' = f(t, X): the rates of change of all numbers of X, in the same order.
using Derivative = std::function<State(double t, const State& x)>;

/// Explicit Euler: X(t + h) = X + h f(t, X). Calls f once. h may have either sign, and may be 0.
State euler_step(const Derivative& f, double t, const State& x, double h);

/// Explicit trapezoidal rule: f0 = f(t, X), f1 = f(t + h, X + h f0), X(t + h) = X + h/2 (f0 + f1). Calls f twice.
State trapezoidal_step(const Derivative& f, double t, const State& x, double h);

/// The classic Runge-Kutta rule of order 4. Calls f four times.
State rk4_step(const Derivative& f, double t, const State& x, double h);
