// a6-solvers: tests, points, and the cases of rate.cpp and leftover.cpp, from eigenvalues by Eigen.
#include <algorithm>
#include <cmath>

#include "tests/coursework/a6-solvers/cases.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Case> weights(Random& random) {
  std::vector<Case> cases;
  for (const int passes : {1, 2, 8}) {
    const double rho = random.uniform(0.5, 0.98);
    Case c{"step.weights", {rho, double(passes)}, {1}, 1, 1e-12, "pass", "weight"};
    // a weight is a ratio of Chebyshev polynomials of neighbouring degrees
    for (int k = 2; k <= passes; ++k)
      c.expected.push_back(2 / rho * a6::left_over(rho, rho, k) / a6::left_over(rho, rho, k - 1));
    cases.push_back(c);
  }
  return cases;
}

// ---- rate

/// A square net whose particles are displaced a little at random. Its springs are stretched if `rest_of_length` < 1.
a6::Scene linearised(Random& random, int side, double rest_of_length) {
  a6::Scene s = a6::square(side, 1, rest_of_length);
  s.mass = random.uniform(0.5, 2), s.h = random.uniform(0.02, 0.05);
  s.stiffness = random.uniform(5, 12) * s.mass / (s.h * s.h);
  for (int i = 0; i < s.x.size(); ++i) s.x.data()[i] += random.uniform(-0.02, 0.02);
  return s;
}
std::pair<double, double> range(const MatrixXd& b) {
  const VectorXd mu = Eigen::SelfAdjointEigenSolver<MatrixXd>(b, Eigen::EigenvaluesOnly).eigenvalues();
  return {mu.minCoeff(), mu.maxCoeff()};
}

Case radius_of(Random& random, const MatrixXd& b, double radius) {
  Case c{"rate.radius", {double(b.rows())}, {radius}, 1, 1e-8 * radius, "matrix", "radius"};
  c.in.insert(c.in.end(), b.data(), b.data() + b.size());
  for (int i = 0; i < b.rows(); ++i) c.in.push_back(random.uniform(0.2, 1));
  return c;
}
std::vector<Case> radii(Random& random) {
  MatrixXd b;
  VectorXd sizes(6);
  do {  // repeats until about a hundred passes suffice to find the largest eigenvalue
    b = linearised(random, 2, 0.9).iteration();
    sizes = Eigen::SelfAdjointEigenSolver<MatrixXd>(b, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
    std::sort(sizes.begin(), sizes.end());
  } while (sizes[4] > 0.98 * sizes[5]);
  // a reflection of a diagonal matrix: its eigenvalues are known, and the largest in magnitude is negative
  VectorXd mu(4), n(4);
  const double r = random.uniform(0.4, 0.6);
  mu << -r, r * random.uniform(0.5, 0.8), r * random.uniform(-0.5, 0.5), r * random.uniform(0.1, 0.4);
  for (double& part : n) part = random.uniform(0.3, 1);
  const MatrixXd mirror = MatrixXd::Identity(4, 4) - 2 * n * n.transpose() / n.squaredNorm();
  return {radius_of(random, b, sizes[5]), radius_of(random, mirror * mu.asDiagonal() * mirror, -mu[0])};
}

/// Factor by which an accelerated pass multiplies an error in the long run.
double growth(double mu, double rho) {
  const double w = 2 / (1 + std::sqrt(1 - rho * rho));
  return a6::growth(w * mu, w - 1);
}
std::vector<Case> factors(Random& random) {
  std::vector<Case> cases;
  for (const double rho : {0., random.uniform(0.5, 0.7), random.uniform(0.8, 0.98)}) {
    Case c{"rate.factor", {rho}, {}, 1, 1e-10, "error", "factor"};
    // |mu| is below rho, above rho, or above 1, but not near rho, where two roots coincide and half the digits are lost
    for (const double mu : {0.5 * rho, -0.7 * rho, rho + 0.6 * (1 - rho), -rho - 0.3 * (1 - rho), 1.03}) {
      c.in.push_back(mu);
      c.expected.push_back(growth(mu, rho));
    }
    cases.push_back(c);
  }
  return cases;
}

/// The rho, found by bisection, above which accelerated passes reduce the slowest error less than plain passes do.
double break_even(double radius) {
  double low = radius, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (growth(radius * (1 - 1e-9), middle) < radius ? low : high) = middle;
  }
  return low;
}
/// Nets that are stretched a little, stretched to many times their rest lengths (every other particle overshoots), or
/// compressed (a buckling mode has zero or negative stiffness).
std::vector<Case> turning_points(Random& random) {
  Case c{"rate.slower", {}, {}, 1, 1e-7, "net", "rho"};
  for (const auto& [side, rest] : {std::pair{4, 0.95}, {3, 0.9}, {9, 0.02}, {4, 1.5}}) {
    const auto [lowest, highest] = range(linearised(random, side, rest).iteration());
    const double radius = std::max(-lowest, highest);
    c.in.insert(c.in.end(), {lowest, highest});
    c.expected.push_back(radius < 1 ? break_even(radius) : 0);
  }
  // the slowest error may be one that alternates in sign
  const double lowest = -random.uniform(0.7, 0.9);
  c.in.insert(c.in.end(), {lowest, random.uniform(0.3, 0.6)});
  c.expected.push_back(break_even(-lowest));
  return {c};
}

// ---- leftover

std::vector<Case> parts_left(Random& random) {
  Case c{"leftover.part", {}, {}, 1, 1e-10, "error", "part"};
  for (const int passes : {0, 1, 2, 5, 32})
    for (const double rho : {0., random.uniform(0.6, 0.9)}) {
      const double mu = random.uniform(-0.6, 0.98);
      c.in.insert(c.in.end(), {mu, rho, double(passes)});
      c.expected.push_back(a6::left_over(mu, rho, passes));
    }
  return {c};
}
std::vector<Case> slow_falls(Random& random) {
  Case c{"leftover.falling", {}, {}, 1, 1e-9, "net", "acceleration"};
  for (const double rho : {0., 0.8, 0.995}) {
    const double mass = random.uniform(0.5, 2), h = random.uniform(0.01, 0.05), g = random.uniform(5, 15);
    const double stiffness = std::round(random.uniform(2, 9) * mass / (h * h));
    const int passes = random.integer(2, 32);
    c.in.insert(c.in.end(), {mass, stiffness, h, rho, double(passes), g});
    const double mu = 1 / (1 + mass / (h * h * 4 * stiffness));
    c.expected.push_back(g - g * a6::left_over(mu, rho, passes));
  }
  return {c};
}
std::vector<Case> growths(Random& random) {
  Case c{"leftover.growth", {}, {}, 1, 1e-9, "error", "growth"};
  for (const int passes : {1, 2, 5, 8})
    for (const double rho : {0., random.uniform(0.6, 0.99)}) {
      // mu as it occurs in nets: at most 1 - inertia, and negative for errors that alternate in sign
      const double inertia = random.uniform(0.02, 0.1),
                   mu = random.uniform(-0.7, passes == 1 ? -0.2 : 1 - 1.5 * inertia);
      const double growth = a6::step_growth(mu, inertia, rho, passes);
      c.in.insert(c.in.end(), {mu, inertia, rho, double(passes)});
      c.expected.push_back(growth);
    }
  return {c};
}
/// The rho at which deviations of a random net begin to grow. Nets are redrawn until deviations also grow for the next
/// higher values of rho, so that a search in the hand-out's steps of rho cannot miss this range. With 16 passes, larger
/// steps miss it. A single pass does not depend on rho: deviations grow for every rho, or for none.
std::vector<Case> divergences(Random& random) {
  std::vector<Case> cases;
  for (const int passes : {random.integer(3, 6), random.integer(7, 11), 1, 16}) {
    double rho = 0;
    bool clear = false;
    while (!clear) {
      const a6::Scene s = linearised(random, 3, 0.9);
      const double inertia = s.mass / (s.h * s.h) / s.slope();
      const VectorXd mu = Eigen::SelfAdjointEigenSolver<MatrixXd>(s.iteration()).eigenvalues();
      rho = a6::diverges_from(mu, inertia, passes);
      clear = passes == 1 || (rho > (passes == 16 ? 0.991 : 0) && rho < 0.997);
      for (int i = 1; i < 5 && clear && passes > 1; ++i) clear = a6::grows(mu, inertia, rho + i * 5e-4, passes);
      Case c{"leftover.diverges", {inertia, double(passes)}, {rho}, 1, 2e-6, "net", "rho"};
      c.in.insert(c.in.end(), mu.begin(), mu.end());
      if (clear) cases.push_back(c);
    }
  }
  return cases;
}

// ---- averaging: a pass multiplies the stretch of a single spring by (0.2 + 1/2) / 1.2

std::vector<Case> stiffnesses(Random& random) {
  Case c{"averaging.stiffness", {}, {}, 1, 0, "spring", "stiffness"};
  for (const int passes : {1, 2, 5, 16}) {
    const double mass = random.uniform(0.5, 2), h = random.uniform(0.01, 0.05), left = std::pow(0.7 / 1.2, passes);
    c.in.insert(c.in.end(), {mass, h, double(passes)});
    const double stretch = left * h * h / (1 - left);  // in units of g
    c.expected.push_back(mass / stretch);
    c.tolerance = 1e-11 * c.expected.back();
  }
  return {c};
}

constexpr Part parts[] = {{"pass", "pass.title"},
                          {"step", "step.title"},
                          {"rate", "rate.title"},
                          {"leftover", "leftover.title"},
                          {"averaging", "averaging.title"}};

const Test tests[] = {
    {"1.1", "pass", 3, 2, {"implicit steps"}, "What a step must solve", a6::inertia_alone},
    {"1.2", "pass", 4, 3, {"implicit steps"}, "What a step must solve", a6::gradients},
    {"1.3", "pass", 4, 3, {"Jacobi iteration"}, "One pass", a6::passes},
    {"2.1", "step", 2, 2, {"Chebyshev acceleration"}, "The weights", weights},
    {"2.2", "step", 5, 3, {"Chebyshev acceleration"}, "A step by passes", a6::steps},
    {"2.3", "step", 3, 2, {"convergence"}, "A step by passes", a6::falling_errors},
    {"2.4", "step", 3, 2, {"rest"}, "At rest", a6::rest_by_passes},
    {"2.5", "step", 2, 2, {"Chebyshev acceleration"}, "The net", a6::course_net},
    {"3.1", "rate", 3, 2, {"spectral radius"}, "How fast errors die out", radii},
    {"3.2", "rate", 3, 3, {"convergence"}, "What acceleration does to one error", factors},
    {"3.3", "rate", 3, 2, {"convergence"}, "Too much acceleration", turning_points},
    {"4.1", "leftover", 3, 2, {"convergence"}, "What is left over", parts_left},
    {"4.2", "leftover", 2, 2, {"softness"}, "A net that falls too slowly", slow_falls},
    {"4.3", "leftover", 3, 2, {"stability"}, "When a step grows", growths},
    {"4.4", "leftover", 3, 2, {"stability", "divergence"}, "When a step grows", divergences},
    {"5.1", "averaging", 4, 3, {"position-based dynamics"}, "Averaging", a6::averages},
    {"5.2", "averaging", 3, 2, {"position-based dynamics"}, "Averaging", a6::averaged_steps},
    {"5.3", "averaging", 2, 2, {"softness"}, "The stiffness that nobody chose", stiffnesses},
    {"5.4", "averaging", 2, 2, {"softness"}, "The stiffness that nobody chose", a6::rest_by_averaging},
};

}  // namespace

const Assignment& a6_solvers() {
  static const Assignment assignment{"a6-solvers", "Solvers", parts, tests};
  return assignment;
}

}  // namespace coursework
