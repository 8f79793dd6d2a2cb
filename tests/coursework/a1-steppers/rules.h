// What the three rules are, as numbers: everything that the right answers are made of. No stepper is in here.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/coursework/check/case.h"

namespace coursework::a1 {

struct Node {
  double time, weight;  // of an integral over one step, both in units of h
};

struct Stage {
  double time;                     // where f is called, in units of h after the start
  std::vector<double> polynomial;  // and at which X, on X' = A X: this polynomial in h A, times the X at the start
};

struct Rule {
  const char* part;
  int order;                // on X' = A X a step multiplies by 1 + h A + ... + (h A)^order / order!
  std::vector<Node> nodes;  // what the rule does where f depends on t alone
  std::vector<Stage> stages;
};

inline Rule euler() { return {"euler", 1, {{0, 1}}, {{0, {1}}}}; }
inline Rule trapezoidal() { return {"trapezoidal", 2, {{0, 1. / 2}, {1, 1. / 2}}, {{0, {1}}, {1, {1, 1}}}}; }
inline Rule rk4() {
  return {"rk4",
          4,
          {{0, 1. / 6}, {1. / 2, 4. / 6}, {1, 1. / 6}},  // Simpson's
          {{0, {1}}, {1. / 2, {1, 1. / 2}}, {1. / 2, {1, 1. / 2, 1. / 4}}, {1, {1, 1, 1. / 2, 1. / 4}}}};
}

/// 1, 1, 1/2, 1/6, ... up to the power `order`.
inline std::vector<double> amplification(int order) {
  std::vector<double> p{1};
  for (int j = 1; j <= order; ++j) p.push_back(p.back() / j);
  return p;
}

/// p(M) z by Horner's scheme.
inline Eigen::VectorXd apply(const std::vector<double>& p, const Eigen::MatrixXd& m, const Eigen::VectorXd& z) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(z.size());
  for (auto coefficient = p.rbegin(); coefficient != p.rend(); ++coefficient) sum = m * sum + *coefficient * z;
  return sum;
}

}  // namespace coursework::a1
