// a5-stiff: tests, points, and expected answers from mysim's tangents and limits, integers, and closed forms.
#include <algorithm>
#include <array>
#include <cmath>

#include "mysim/model/system.h"
#include "mysim/steppers/steppers.h"
#include "tests/coursework/a5-stiff/tests_motion.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {
namespace a5 {
Looked equation_text(const Texts& common, const std::string& part, const Ask& student);  // equation.cpp
}
namespace {

namespace limits = crosscheck::limits;
using crosscheck::Points;

// order of the starter's enum
enum Rule { explicit_euler, trapezoidal, rk4, symplectic_euler, leapfrog, implicit_euler };

// ---- jacobian: from mysim's tangent of one spring

Case jacobian(const Points& ends, double k, double rest) {
  crosscheck::Particles two;
  two.mass = Eigen::VectorXd::Ones(2), two.pinned.assign(2, 0);
  crosscheck::Tangent tangent;
  add_tangent(crosscheck::Springs{{{0, 1, k, rest, crosscheck::Family::single}}}, two, {0, ends, Points::Zero(3, 2)},
              crosscheck::Curvature::exact, tangent);
  Case c;
  c.call = "jacobian.matrix", c.columns = 3, c.row = "line", c.column = "derivative";
  const crosscheck::Vec3 d = ends.col(0) - ends.col(1);
  c.in = {d[0], d[1], d[2], k, rest};
  c.expected.resize(9);
  for (int j = 0; j < 3; ++j) {
    Points unit = Points::Zero(3, 2), out = Points::Zero(3, 2);
    unit(j, 0) = 1;
    tangent.add_product(1, 0, unit, out);
    for (int i = 0; i < 3; ++i) c.expected[3 * i + j] = -out(i, 0);
  }
  c.tolerance = 1e-11 * k;  // allows for a dozen roundings of numbers below 3 k
  return c;
}

/// Springs of 0.2 m to 0.7 m, with a random ratio of length to rest length between the two bounds.
std::vector<Case> springs(Random& random, double shortest, double longest) {
  std::vector<Case> cases;
  while (cases.size() < 3) {
    Points ends = Points::Zero(3, 2);
    for (int i = 0; i < 3; ++i) ends(i, 0) = random.uniform(-0.5, 0.5);
    const double length = ends.col(0).norm(), k = random.uniform(10, 1000), part = random.uniform(shortest, longest);
    if (length > 0.2 && length < 0.7) cases.push_back(jacobian(ends, k, length / part));
  }
  return cases;
}
std::vector<Case> stretched(Random& random) { return springs(random, 1.2, 3); }
std::vector<Case> shortened(Random& random) { return springs(random, 0.3, 0.8); }
std::vector<Case> at_rest(Random& random) {
  std::vector<Case> cases = springs(random, 1, 1);
  cases.push_back(jacobian(Points::Zero(3, 2), random.uniform(10, 1000), random.uniform(0.5, 2)));
  return cases;
}

/// A stretched, a compressed and an unstretched spring along an axis, for which the matrix is diagonal; a spring at an
/// angle to two axes; and one of length 0.
std::vector<Case> small_springs(Random&) {
  std::vector<Case> cases;
  for (const auto& [x, y, rest] : {std::array{2., 0., 1.}, std::array{2., 0., 3.}, std::array{2., 0., 2.},
                                   std::array{3., 4., 1.}, std::array{0., 0., 1.}}) {
    Points ends = Points::Zero(3, 2);
    ends(0, 0) = x, ends(1, 0) = y;
    cases.push_back(jacobian(ends, 10, rest));
  }
  return cases;
}

// ---- linear: integers, so that b = a x is exact

using Rows = std::vector<Numbers>;

/// A matrix whose diagonal entries are even numbers from 20 to 40. Its other entries are from `low` to `high`, at most
/// 3 in magnitude. If n <= 6, each diagonal entry exceeds the sum of the other magnitudes in its column by at least 5.
/// Therefore the norm of the inverse is at most 0.2, the condition number below 12, and the error below 1e-13.
Rows strong_diagonal(Random& random, int n, int low, int high) {
  Rows a(n, Numbers(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a[i][j] = i == j ? 2 * random.integer(10, 20) : random.integer(low, high);
  return a;
}
Case linear(const std::string& call, const Rows& a, const Numbers& x, double scale = 1) {
  Case c;
  c.call = call, c.row = "unknown", c.column = "x", c.tolerance = 1e-11, c.expected = x;
  c.in = {static_cast<double>(a.size())};
  Numbers b;
  for (const Numbers& row : a) {
    double sum = 0;
    for (size_t j = 0; j < x.size(); ++j) c.in.push_back(scale * row[j]), sum += row[j] * x[j];
    b.push_back(scale * sum);
  }
  c.in.insert(c.in.end(), b.begin(), b.end());
  return c;
}
Numbers whole(Random& random, int n) {
  Numbers x;
  for (int i = 0; i < n; ++i) x.push_back(random.integer(1, 9) * (random.integer(0, 1) ? 1 : -1));
  return x;
}

std::vector<Case> plain_systems(Random& random) {
  return {linear("linear.solve", strong_diagonal(random, 3, -3, 3), whole(random, 3)),
          linear("linear.solve", strong_diagonal(random, 6, -3, 3), whole(random, 6)),
          // entries are scaled by a small power of two, but the matrix is not singular
          linear("linear.solve", strong_diagonal(random, 4, -3, 3), whole(random, 4), 0x1p-60)};
}
std::vector<Case> pivoting(Random& random) {
  std::vector<Case> cases;
  for (const int sign : {-1, 1}) {
    Rows a = strong_diagonal(random, 5, -3, -1);
    for (int i = 0; i < 5; ++i) a[i][i] *= sign;
    std::rotate(a.begin(), a.begin() + 1, a.end());  // moves the large entries off the diagonal
    for (int i = 0; i < 5; ++i) a[i][i] = 0;
    cases.push_back(linear("linear.solve", a, whole(random, 5)));
  }
  return cases;
}
std::vector<Case> singular(Random& random) {
  std::vector<Case> cases;
  for (const int n : {3, 4}) {
    Rows a = strong_diagonal(random, n, n == 3 ? -3 : 1, 3);
    for (int j = 0; j < n; ++j) a[n - 1][j] = (a[0][j] + a[1][j]) / 2;
    // the larger matrix has only negative entries, and its last pivot is small but not zero
    if (n == 4) a[3][3] += 2e-13;
    cases.push_back(linear("linear.singular", a, whole(random, n), n == 3 ? 1 : -1));
    cases.back().expected = {1}, cases.back().row = "call", cases.back().column = "thrown";
  }
  return cases;
}

/// A diagonal matrix, one with an entry below the diagonal, two with entries above it, and a full one.
std::vector<Case> small_plain(Random& random) {
  return {linear("linear.solve", {{4, 0}, {0, 8}}, whole(random, 2)),
          linear("linear.solve", {{8, 0}, {4, 2}}, whole(random, 2)),
          linear("linear.solve", {{4, 2}, {0, 8}}, whole(random, 2)),
          linear("linear.solve", {{4, 2, 1}, {0, 8, 2}, {0, 0, 4}}, whole(random, 3)),
          linear("linear.solve", strong_diagonal(random, 2, 1, 3), whole(random, 2))};
}
std::vector<Case> small_pivoting(Random& random) {
  return {linear("linear.solve", {{0, 2}, {4, 0}}, whole(random, 2)),
          linear("linear.solve", {{0, 2}, {4, 1}}, whole(random, 2))};
}
std::vector<Case> small_singular(Random& random) {
  Case c = linear("linear.singular", {{2, 4}, {1, 2}}, whole(random, 2));
  c.expected = {1}, c.row = "call", c.column = "thrown";
  return {c};
}

// ---- limits

using Limit = double (*)(double, double);

/// One oscillator per ratio gamma / omega; a negative ratio means omega = 0.
Case limit(Random& random, Rule rule, Limit right, const std::vector<double>& ratios) {
  Case c;
  c.call = "limits.step", c.columns = 2, c.row = "oscillator", c.column = "limit";
  c.in = {static_cast<double>(rule)};
  double smallest = 1;
  for (const double ratio : ratios) {
    const double spring = random.uniform(1, 30), drag = random.uniform(0.95, 1.05) * std::abs(ratio) * spring;
    const double omega = ratio < 0 ? 0 : spring, h = right(omega, drag);
    c.in.insert(c.in.end(), {omega, drag});
    const double kind = std::isinf(h) ? 2 : h == 0 ? 0 : 1;
    c.expected.insert(c.expected.end(), {kind, kind == 1 ? h : 0});
    if (kind == 1) smallest = std::min(smallest, h);
  }
  c.tolerance = 1e-7 * smallest;  // the hand-out asks for eight digits
  return c;
}

std::vector<Case> euler_limits(Random& random) {
  return {limit(random, explicit_euler, limits::explicit_euler, {0.2, 1.2, 2.5, 5, -3})};
}
std::vector<Case> runge_kutta_limits(Random& random) {
  return {limit(random, trapezoidal, limits::trapezoidal, {0.3, 1.2, 3, -2}),
          limit(random, rk4, limits::rk4, {0, 0.3, 1.2, 3, -2})};
}
std::vector<Case> symplectic_limits(Random& random) {
  return {limit(random, symplectic_euler, limits::symplectic_euler, {0, 0.5, 1.5, 4, -2}),
          limit(random, leapfrog, limits::leapfrog, {0, 0.5, 3})};
}
std::vector<Case> none_and_all(Random& random) {
  std::vector<Case> cases = {limit(random, explicit_euler, limits::explicit_euler, {0, 0}),
                             limit(random, trapezoidal, limits::trapezoidal, {0, 0}),
                             limit(random, implicit_euler, limits::none, {0, 0.5, 4, -2}),
                             limit(random, leapfrog, limits::leapfrog, {-1, -4})};
  // an oscillator with neither spring nor drag
  for (const Rule rule : {explicit_euler, trapezoidal, rk4, symplectic_euler, leapfrog}) {
    cases.push_back(limit(random, rule, limits::none, {-1}));
    cases.back().in[2] = 0;
  }
  return cases;
}

// ---- choose: the hand-out's table of errors, solved for h

struct Accuracy {
  Rule rule;
  double order, constant;
};
constexpr Accuracy table[] = {
    {rk4, 4, 1. / 120}, {symplectic_euler, 2, 1. / 24}, {leapfrog, 2, 1. / 24}, {implicit_euler, 1, 1. / 2}};

Case predicted(Rule rule) {
  Case c;
  c.call = "choose.predicted", c.row = "oscillator", c.column = "chosen", c.in = {static_cast<double>(rule)};
  return c;
}
/// Divides the duration into steps of at most h. Returns false if rounding could decide the number of steps.
bool add(Case& c, double omega, double duration, double tolerance, double h) {
  const double steps = duration / h, over = steps - std::floor(steps);
  if (over < 0.05 || over > 0.95) return false;
  c.in.insert(c.in.end(), {omega, duration, tolerance});
  c.expected.push_back(duration / std::ceil(steps));
  c.tolerance = 1e-10 * duration / steps;  // allows for one root and a few roundings
  return true;
}

std::vector<Case> accurate_steps(Random& random) {
  std::vector<Case> cases;
  for (const auto& [rule, order, constant] : table) {
    Case c = predicted(rule);
    while (c.expected.size() < 3) {
      // h omega is from 0.1 to 0.5, far below every limit of stability
      const double omega = random.uniform(2, 30), wanted = random.uniform(0.1, 0.5) / omega;
      // if numbers have few digits, half a step more, so that rounding cannot decide the number of steps
      const double duration = (random.uniform(8, 40) + (random.rounds() ? 0.5 : 0)) * wanted;
      add(c, omega, duration, constant * omega * duration * std::pow(wanted * omega, order), wanted);
    }
    // a single step suffices
    const double omega = random.uniform(2, 30), wanted = random.uniform(0.1, 0.5) / omega,
                 duration = random.uniform(0.3, 0.8) * wanted;
    add(c, omega, duration, constant * omega * duration * std::pow(wanted * omega, order), wanted);
    if (rule == implicit_euler) {
      // omega and h are powers of two, so that every formula gives exactly the same integer number of steps
      const double h = 1.0 / 32, whole = random.integer(5, 30) * h;
      c.in.insert(c.in.end(), {4, whole, constant * 4 * whole * 4 * h}), c.expected.push_back(h);
    }
    cases.push_back(c);
  }
  return cases;
}

std::vector<Case> stable_steps(Random& random) {
  std::vector<Case> cases;
  for (const auto& [rule, limit_of] : {std::pair<Rule, Limit>{rk4, limits::rk4},
                                       {leapfrog, limits::leapfrog},
                                       {symplectic_euler, limits::symplectic_euler}}) {
    Case c = predicted(rule);
    while (c.expected.size() < 2) {
      const double omega = random.uniform(2, 30), h = 0.9 * limit_of(omega, 0);
      // the tolerance is so large that accuracy alone would allow a step of more than ten times the limit
      add(c, omega, (random.uniform(4, 12) + (random.rounds() ? 0.5 : 0)) * h, 1e6, h);
    }
    cases.push_back(c);
    cases.back().tolerance *= 1e3;  // the hand-out asks for only eight digits of a limit
  }
  for (const Rule rule : {explicit_euler, trapezoidal}) {
    Case c = predicted(rule);
    c.in.insert(c.in.end(), {random.uniform(2, 30), random.uniform(1, 3), 1e-3});
    c.expected = {0}, c.tolerance = 1e-12;
    cases.push_back(c);
  }
  return cases;
}

std::vector<Case> measured_steps(Random& random) {
  std::vector<Case> cases;
  for (const int order : {1, 2, 4}) {
    const double h = random.uniform(0.2, 0.6);
    Case c;
    c.call = "choose.measured", c.row = "call", c.column = "chosen";
    const double tolerance = std::pow(10, random.uniform(-4, -2));
    c.in = {static_cast<double>(order), h, tolerance, 3};
    for (int i = 0; i < 3; ++i) c.in.push_back(random.uniform(-1, 1));
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      c.in.push_back(random.uniform(0.5, 3) * (random.integer(0, 1) ? 1 : -1));
      largest = std::max(largest, std::abs(c.in.back()));
    }
    // the error of a run is exactly c h^p
    c.expected = {std::pow(tolerance / largest, 1. / order)};
    c.tolerance = 1e-10 * c.expected[0];  // the two final states are of size 1 and differ by more than 1e-3
    cases.push_back(c);
  }
  return cases;
}

constexpr Part parts[] = {{"jacobian", "jacobian.title"},
                          {"linear", "linear.title"},
                          {"implicit_euler", "implicit_euler.title"},
                          {"limits", "limits.title"},
                          {"choose", "choose.title"}};

const Test tests[] = {
    {"1.1", "jacobian", 3, 3, {"jacobian"}, "The stiffness of a spring", stretched, nullptr, small_springs},
    {"1.2",
     "jacobian",
     3,
     3,
     {"jacobian", "compression"},
     "The stiffness of a spring",
     shortened,
     nullptr,
     small_springs},
    {"1.3", "jacobian", 2, 2, {"jacobian", "edge cases"}, "The stiffness of a spring", at_rest, nullptr, small_springs},
    {"2.1", "linear", 3, 3, {"elimination"}, "Solving the equations", plain_systems, nullptr, small_plain},
    {"2.2", "linear", 2, 3, {"elimination", "pivoting"}, "Solving the equations", pivoting, nullptr, small_pivoting},
    {"2.3", "linear", 1, 2, {"elimination", "edge cases"}, "Solving the equations", singular, nullptr, small_singular},
    {"3.1", "implicit_euler", 4, 4, {"implicit steps", "damping"}, "One implicit step", a5::one_spring},
    {"3.2", "implicit_euler", 3, 3, {"implicit steps", "drag"}, "One implicit step", a5::gravity_and_drag},
    {"3.3",
     "implicit_euler",
     4,
     4,
     {"implicit steps", "assembly"},
     "Putting the blocks together",
     a5::network,
     nullptr,
     a5::small_network},
    {"3.4",
     "implicit_euler",
     4,
     4,
     {"implicit steps", "constraints"},
     "Particles that are fixed",
     a5::stiff_chain,
     nullptr,
     a5::small_stiff_chain},
    {"4.1", "limits", 3, 3, {"stability"}, "Rule by rule", euler_limits},
    {"4.2", "limits", 3, 3, {"stability"}, "Rule by rule", runge_kutta_limits},
    {"4.3", "limits", 3, 3, {"stability"}, "Rule by rule", symplectic_limits},
    {"4.4", "limits", 3, 3, {"stability", "edge cases"}, "None and all", none_and_all},
    {"5.1", "choose", 3, 3, {"accuracy"}, "A step for a tolerance", accurate_steps},
    {"5.2", "choose", 2, 2, {"stability"}, "A step for a tolerance", stable_steps},
    {"5.3", "choose", 3, 3, {"accuracy", "step halving"}, "Measuring the error", measured_steps},
};

}  // namespace

const Assignment& a5_stiff() {
  static const Assignment assignment{"a5-stiff", "Stiff springs", parts, tests, nullptr, {}, a5::equation_text};
  return assignment;
}

}  // namespace coursework
