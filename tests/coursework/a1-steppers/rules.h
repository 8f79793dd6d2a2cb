// The three rules as numbers, from which all expected answers are computed. Contains no stepper.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace coursework::a1 {

struct Node {
  double time, weight;  // a quadrature node and its weight over one step, in units of h
};

struct Stage {
  double time;                     // time of the call of f, in units of h after the start
  std::vector<double> polynomial;  // coefficients of p: for X' = A X, f is called at the state p(h A) X_0
};

struct Rule {
  const char* part;
  int order;                // for X' = A X a step multiplies X by 1 + h A + ... + (h A)^order / order!
  std::vector<Node> nodes;  // quadrature if f depends on t alone
  std::vector<Stage> stages;
};

inline Rule euler() { return {"euler", 1, {{0, 1}}, {{0, {1}}}}; }
inline Rule trapezoidal() { return {"trapezoidal", 2, {{0, 1. / 2}, {1, 1. / 2}}, {{0, {1}}, {1, {1, 1}}}}; }
inline Rule rk4() {
  return {"rk4",
          4,
          {{0, 1. / 6}, {1. / 2, 4. / 6}, {1, 1. / 6}},  // Simpson's rule
          {{0, {1}}, {1. / 2, {1, 1. / 2}}, {1. / 2, {1, 1. / 2, 1. / 4}}, {1, {1, 1, 1. / 2, 1. / 4}}}};
}

/// Returns 1, 1, 1/2, 1/6, ... up to the power `order`.
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
