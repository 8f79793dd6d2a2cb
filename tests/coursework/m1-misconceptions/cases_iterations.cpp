// Expected answers from matrices: an iteration over the springs is a Gauss-Seidel iteration for the pulls of the
// implicit step; the true motion is a sum of normal modes.
#include <Eigen/Dense>

#include "tests/coursework/m1-misconceptions/cases.h"

namespace coursework::m1 {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Hanging {
  int n;
  double mass, stiffness, rest, gravity;
  VectorXd x, v;

  /// The matrix G with which G x - rest are the stretches.
  MatrixXd gradient() const {
    MatrixXd g = MatrixXd::Identity(n, n);
    g.diagonal(-1).setConstant(-1);
    return g;
  }
};

Hanging hanging(Random& random, int n, double softest, double stiffest) {
  Hanging c{n, random.uniform(0.1, 0.5), random.uniform(softest, stiffest), random.uniform(0.1, 0.5), 9.8, {}, {}};
  c.x = c.v = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) c.x[i] = (i + 1) * c.rest;
  return c;
}

/// Performs a step. The pulls p (times h^2) satisfy A p = -stretch with A = G G^T / m + 1 / (k h^2). If the number of
/// iterations is negative, solves the equation exactly, which gives implicit Euler.
void step(Hanging& c, double h, int iterations) {
  const MatrixXd g = c.gradient();
  const VectorXd start = c.x, ahead = c.x + h * c.v + VectorXd::Constant(c.n, h * h * c.gravity);
  const MatrixXd a = g * g.transpose() / c.mass + MatrixXd::Identity(c.n, c.n) / (c.stiffness * h * h);
  const VectorXd b = VectorXd::Constant(c.n, c.rest) - g * ahead;
  VectorXd pulls = VectorXd::Zero(c.n);
  if (iterations < 0) pulls = a.ldlt().solve(b);
  for (int i = 0; i < iterations; ++i) {
    const VectorXd rest = b - a.triangularView<Eigen::StrictlyUpper>() * pulls;
    pulls = a.triangularView<Eigen::Lower>().solve(rest);
  }
  c.x = ahead + g.transpose() * pulls / c.mass;
  c.v = (c.x - start) / h;
}

Hanging advanced(Hanging c, double frame, int steps, int iterations) {
  for (int i = 0; i < steps; ++i) step(c, frame / steps, iterations);
  return c;
}

/// The true depths after the given time.
VectorXd moved(const Hanging& c, double time) {
  const MatrixXd g = c.gradient();
  const MatrixXd k = c.stiffness / c.mass * g.transpose() * g;
  const VectorXd middle = k.ldlt().solve(c.stiffness / c.mass * g.transpose() * VectorXd::Constant(c.n, c.rest) +
                                         VectorXd::Constant(c.n, c.gravity));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(k);
  const Eigen::ArrayXd omega = modes.eigenvalues().array().sqrt();
  const Eigen::ArrayXd away = modes.eigenvectors().transpose() * (c.x - middle),
                       speed = modes.eigenvectors().transpose() * c.v;
  const VectorXd now = away * (omega * time).cos() + speed / omega * (omega * time).sin();
  return middle + modes.eigenvectors() * now;
}

Numbers numbers(const Hanging& c, double frame, int steps, int iterations) {
  Numbers in{double(c.n), double(steps), double(iterations), frame, c.mass, c.stiffness, c.rest, c.gravity};
  in.insert(in.end(), c.x.begin(), c.x.end());
  in.insert(in.end(), c.v.begin(), c.v.end());
  return in;
}

/// The largest distance of a particle from the true motion in ten frames.
double error_of(const Hanging& start, double frame, int steps, int iterations) {
  Hanging c = start;
  double largest = 0;
  for (int i = 1; i <= 10; ++i) {
    c = advanced(c, frame, steps, iterations);
    largest = std::max(largest, (c.x - moved(start, i * frame)).cwiseAbs().maxCoeff());
  }
  return largest;
}

struct Choice {
  int budget;
  std::vector<int> steps;  // the divisors of the budget
  Numbers errors;

  std::size_t best() const {
    return static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
  }
  Case asked() const {
    Case c{"iterations.choose", {double(budget), double(steps.size())}, {}, 2, 0.1, "plan", "plan"};
    for (std::size_t i = 0; i < steps.size(); ++i)
      c.in.insert(c.in.end(), {double(steps[i]), double(budget / steps[i]), errors[i]});
    c.expected = {double(steps[best()]), double(budget / steps[best()])};  // integers
    return c;
  }
};

Choice plans(int budget) {
  Choice all{budget, {}, {}};
  for (int steps = 1; steps <= budget; ++steps)
    if (budget % steps == 0) all.steps.push_back(steps);
  return all;
}

}  // namespace

std::vector<Case> frames(Random& random) {
  std::vector<Case> cases;
  for (const auto& [n, steps, iterations] : {std::array{1, 1, 1}, std::array{2, 2, 1}, std::array{3, 3, 4}}) {
    Hanging c = hanging(random, n, 200, 900);
    for (int i = 0; i < n; ++i)
      c.x[i] += random.uniform(0.01, 0.05), c.v[i] = random.uniform(1, 3) * (random.integer(0, 1) ? 1 : -1);
    const double frame = random.uniform(0.02, 0.05);
    Case asked{"iterations.frame", numbers(c, frame, steps, iterations), {}, 2, 0, "particle", "line"};
    const Hanging later = advanced(c, frame, steps, iterations);
    for (int i = 0; i < n; ++i) asked.expected.insert(asked.expected.end(), {later.x[i], later.v[i]});
    // twelve iterations over three springs cause 500 roundings of depths below 4 m, and of speeds, which are depths
    // divided by a step
    asked.tolerance = 500 * 1.2e-16 * 4 / (frame / steps);
    cases.push_back(asked);
  }
  return cases;
}

/// An iteration multiplies the error by less than 0.9 (by cos^2 of pi / (2 n + 1) for rigid springs). After 400
/// iterations the error is below round-off, and the answer is that of implicit Euler.
std::vector<Case> many(Random& random) {
  std::vector<Case> cases;
  for (const int n : {3, 4}) {
    Hanging c = hanging(random, n, 200, 900);
    for (double& speed : c.v) speed = random.uniform(1, 3);
    const double frame = random.uniform(0.02, 0.05);
    Case asked{"iterations.many", numbers(c, frame, 1, 400), {}, 1, 0, "iterations", "depth"};
    for (const int iterations : {1, 2, 5, 20, -1}) asked.expected.push_back(advanced(c, frame, 1, iterations).x[n - 1]);
    asked.in.push_back(moved(c, frame)[n - 1]);
    asked.tolerance = 1e-12;  // iterations damp earlier round-off: only a few roundings of depths below 4 m remain
    cases.push_back(asked);
  }
  return cases;
}

/// Cases with artificial errors. For a budget of 12 the first plan is the best; for the other budgets, the best plan is
/// neither the first nor the last.
std::vector<Case> tables(Random& random) {
  std::vector<Case> cases;
  for (const int budget : {6, 12, 16}) {
    Choice all = plans(budget);
    for (std::size_t i = 0; i < all.steps.size(); ++i) all.errors.push_back(random.uniform(0.2, 0.9));
    const int inside = random.integer(1, static_cast<int>(all.steps.size()) - 2);
    all.errors[budget == 12 ? 0 : static_cast<std::size_t>(inside)] = random.uniform(0.01, 0.09);
    cases.push_back(all.asked());
  }
  return cases;
}

/// Cases with errors of real chains. Chains are redrawn until the plan with the most steps is clearly the best, which
/// is nearly always the case within these ranges of stiffnesses and frames.
std::vector<Case> measured(Random& random) {
  std::vector<Case> cases;
  for (const int budget : {4, 8}) {
    for (;;) {
      const Hanging c = hanging(random, random.integer(3, 5), 100, 600);
      const double frame = random.uniform(0.01, 0.02);
      Choice all = plans(budget);
      for (const int steps : all.steps) all.errors.push_back(error_of(c, frame, steps, budget / steps));
      const double last = all.errors.back();
      if (all.errors.front() < 2 * last || all.errors[all.errors.size() - 2] < 1.2 * last) continue;
      cases.push_back(all.asked());
      break;
    }
  }
  return cases;
}

}  // namespace coursework::m1
