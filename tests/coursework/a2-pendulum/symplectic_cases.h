// Tests of symplectic Euler on the grader's own systems.
#pragma once

#include <cmath>

#include "tests/coursework/a2-pendulum/energy.h"

namespace coursework::a2 {

struct System {
  Eigen::MatrixXd k;                // n x n, 1/s^2: acceleration g - c v - K x
  double c = 0;                     // 1/s
  Vector gravity = Vector::Zero();  // m/s^2
};

inline Case symplectic_case(const char* call, const System& s, const std::vector<Motion>& state, int steps, double h) {
  const int n = static_cast<int>(state.size());
  Case made{
      call, {static_cast<double>(n), static_cast<double>(steps), h}, {}, 6 * n, 0, "step", n == 1 ? "state" : "states"};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) made.in.push_back(s.k(i, j));
  made.in.push_back(s.c);
  put(s.gravity, made.in), put(state, made.in);
  return made;
}

inline std::vector<Motion> moving(Random& random, int n) {
  std::vector<Motion> state;
  for (int i = 0; i < n; ++i)
    state.push_back({random_direction(random) * 2, random_direction(random) * random.uniform(1, 3)});
  return state;
}

inline System coupled(Random& random, int n) {
  System s{Eigen::MatrixXd(n, n), random.uniform(0.3, 1), random.uniform(2, 10) * random_direction(random)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) s.k(i, j) = random.uniform(0.5, 3) * (i == j ? 1 : -1);
  return s;
}

/// One step as one matrix: x+ = (1 - h^2 K) x + h (1 - h c) v + h^2 g and v+ = -h K x + (1 - h c) v + h g.
inline std::vector<Case> one_step_cases(Random& random) {
  std::vector<Case> cases;
  for (const int n : {1, 2, 4}) {
    const double h = random.uniform(0.1, 0.3);
    const System s = coupled(random, n);
    const auto state = moving(random, n);
    Case c = symplectic_case("symplectic", s, state, 1, h);
    for (int i = 0; i < n; ++i) {
      Vector stiff = Vector::Zero();
      for (int j = 0; j < n; ++j) stiff += s.k(i, j) * state[j].x;
      put(state[i].x - h * h * stiff + h * (1 - h * s.c) * state[i].v + h * h * s.gravity, c.expected);
      put(-h * stiff + (1 - h * s.c) * state[i].v + h * s.gravity, c.expected);
    }
    c.row = "particle", c.column = "state", c.columns = 6;
    c.tolerance = round_off(100);
    cases.push_back(c);
  }
  return cases;
}

/// Free fall in closed form: v_k = v + k h g, x_k = x + k h v + h^2 g k (k + 1) / 2.
inline std::vector<Case> fall_cases(Random& random) {
  const int n = 2, steps = 30;
  const double h = random.uniform(0.02, 0.05);
  const System s{Eigen::MatrixXd::Zero(n, n), 0, Vector(0, -random.uniform(2, 10), 0)};
  const auto state = moving(random, n);
  Case c = symplectic_case("symplectic", s, state, steps, h);
  for (int k = 1; k <= steps; ++k)
    for (const Motion& one : state) {
      put(one.x + k * h * one.v + h * h * s.gravity * (k * (k + 1) / 2.), c.expected);
      put(one.v + k * h * s.gravity, c.expected);
    }
  c.tolerance = steps * round_off(100);
  c.plot_y = 1, c.row_size = h;
  return {c};
}

/// An oscillator without drag. Positions satisfy x_(k+1) - 2 cos(theta) x_k + x_(k-1) = 0 with
/// cos(theta) = 1 - (omega h)^2 / 2, so they are a cosine and a sine of k theta: the motion never grows.
inline std::vector<Case> oscillator_cases(Random& random) {
  std::vector<Case> cases;
  for (const double angle : {random.uniform(0.2, 0.4), random.uniform(1.2, 1.8)}) {
    const double omega = random.uniform(1, 4), h = angle / omega, theta = std::acos(1 - angle * angle / 2);
    const int steps = 40;
    const auto state = moving(random, 1);
    Case c = symplectic_case("symplectic", {Eigen::MatrixXd::Constant(1, 1, omega * omega)}, state, steps, h);
    const Vector x0 = state[0].x, x1 = (1 - angle * angle) * x0 + h * state[0].v;
    const Vector sine = (x1 - x0 * std::cos(theta)) / std::sin(theta);
    const auto at = [&](int k) -> Vector { return x0 * std::cos(k * theta) + sine * std::sin(k * theta); };
    for (int k = 1; k <= steps; ++k) put(at(k), c.expected), put((at(k) - at(k - 1)) / h, c.expected);
    // rounding changes theta by epsilon / sin(theta), and velocities are differences divided by h
    c.tolerance = steps * round_off(100) / (h * std::sin(theta));
    c.plot_x = 0, c.plot_y = 3;
    cases.push_back(c);
  }
  return cases;
}

/// f must be called once, at the given state, and the argument must not change.
inline std::vector<Case> evaluation_cases(Random& random) {
  std::vector<Case> cases;
  for (const int n : {1, 3}) {
    const auto state = moving(random, n);
    Case c = symplectic_case("symplectic.points", coupled(random, n), state, 1, random.uniform(0.1, 0.3));
    c.row = "evaluation";
    put(state, c.expected);
    c.tolerance = round_off(10);
    cases.push_back(c);
    c.call = "symplectic.kept", c.row = "step";
    cases.push_back(c);
  }
  return cases;
}

}  // namespace coursework::a2
