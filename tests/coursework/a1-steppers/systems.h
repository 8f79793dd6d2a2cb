// Seeded systems: the numbers of a call, and the states that a rule computes for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/coursework/a1-steppers/rules.h"
#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"

namespace coursework::a1 {

using Eigen::VectorXd;

/// x' = A x + b + c t in autonomous form: (x, t, 1)' = M (x, t, 1). An explicit Runge-Kutta rule advances t exactly if
/// each stage time is the row sum of the stage's weights, so both forms give the same result.
struct Linear {
  int n;
  Eigen::MatrixXd m;  // (n + 2) x (n + 2)
  Eigen::VectorXd z;  // n + 2: initial x, t, 1
};

/// Round-off bound: a step of n numbers takes fewer than 10 n + 40 sums and products, however it is written. Each has
/// an error of half an epsilon times `size`, where `size` bounds the numbers. The errors of all steps add up.
inline double round_off(int n, int steps, double size) { return steps * (10 * n + 40) * 1.2e-16 * size; }

inline std::string call(const Rule& rule, const char* what) { return std::string(rule.part) + "." + what; }

inline void put(const VectorXd& x, Numbers& out) { out.insert(out.end(), x.begin(), x.end()); }

inline void put_random(Random& random, int n, double low, double high, Numbers& out) {
  for (int i = 0; i < n; ++i) out.push_back(random.uniform(low, high));
}

/// Numbers that begin every call: n, steps, t, h, x. t is never 0, so that a forgotten t is detected.
inline Numbers start(Random& random, int n, int steps, double h) {
  Numbers in{static_cast<double>(n), static_cast<double>(steps), random.uniform(0.5, 2), h};
  put_random(random, n, 0.5, 2, in);
  return in;
}

enum class Depends { on_state, on_state_and_time };

/// Adds a seeded A (and b and c) to the call and returns the system with the matching M.
inline Linear add_linear(Random& random, Depends depends, Numbers& in) {
  const int n = static_cast<int>(in[0]);
  Linear s{n, Eigen::MatrixXd::Zero(n + 2, n + 2), VectorXd::Ones(n + 2)};
  // row sums of about 1, so that states of 8 numbers stay as small as states of a single number
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double scale = random.rounds() ? 1 : std::sqrt(n);
      in.push_back(random.uniform(0.3, 1.5) * (random.integer(0, 1) ? 1 : -1) / scale);
      s.m(i, j) = in.back();
    }
  for (const int column : {n + 1, n})  // b in column n + 1 multiplies the 1, c in column n multiplies t
    for (int i = 0; i < n; ++i) {
      in.push_back(depends == Depends::on_state ? 0 : random.uniform(0.5, 1.5));
      s.m(i, column) = in.back();
    }
  s.m(n, n + 1) = 1;
  for (int i = 0; i < n; ++i) s.z[i] = in[4 + i];
  s.z[n] = in[2];
  return s;
}

inline Case linear_case(const Rule& rule, Random& random, Depends depends, int n, int steps, double h) {
  Case c{call(rule, "linear"), start(random, n, steps, h), {}, n, 0, "step", "state"};
  Linear s = add_linear(random, depends, c.in);
  double size = 1;
  for (int k = 0; k < steps; ++k) {
    size = std::max(size, s.z.norm() * std::exp(std::abs(h) * s.m.norm()));
    s.z = apply(amplification(rule.order), h * s.m, s.z);
    put(s.z.head(n), c.expected);
  }
  c.tolerance = round_off(n, steps, size);
  return c;
}

}  // namespace coursework::a1
