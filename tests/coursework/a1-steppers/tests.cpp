// The tests of a1-steppers. Expected answers are closed forms of each rule: amplification polynomials in h A, complex
// powers on the circle, quadrature if f depends on t alone, and exact solutions for the order.
#include <cmath>
#include <complex>

#include "tests/coursework/a1-steppers/systems.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {
namespace a1 {
Looked tableau_text(const Texts& common, const std::string& part, const Ask& student);  // tableau.cpp
}
namespace {

using namespace a1;

template <Rule rule()>
std::vector<Case> one_step(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 4; ++i)
    cases.push_back(linear_case(rule(), random, Depends::on_state, 2, 1, random.uniform(0.2, 0.7)));
  return cases;
}

/// For x' = omega (-y, x) every step multiplies the complex number x + i y by p(i omega h).
template <Rule rule()>
std::vector<Case> circle(Random& random) {
  std::vector<Case> cases;
  // three step sizes: typical, too large for accuracy, and beyond the stability limit of RK4 (2 sqrt 2)
  for (const auto& [angle, steps] : {std::pair{random.uniform(0.2, 0.4), 40}, std::pair{random.uniform(0.8, 1.2), 12},
                                     std::pair{random.uniform(2.9, 3.1), 5}}) {
    const double omega = random.uniform(0.5, 3);
    Case c{call(rule(), "circle"), start(random, 2, steps, angle / omega), {}, 3, 0, "step", "circle"};
    c.in.push_back(omega);
    std::complex<double> factor = 0, power = 1;
    for (const double coefficient : amplification(rule().order)) {
      factor += coefficient * power;
      power *= std::complex<double>(0, angle);
    }
    const std::complex<double> begin(c.in[4], c.in[5]);
    for (int k = 1; k <= steps; ++k) {
      const std::complex<double> z = begin * std::polar(std::pow(std::abs(factor), k), k * std::arg(factor));
      c.expected.insert(c.expected.end(), {z.real(), z.imag(), std::abs(factor)});
    }
    // within a step, numbers reach exp(angle) times the state, which is largest at the start or at the end of the run
    const double size = std::abs(begin) * std::max(1., std::pow(std::abs(factor), steps)) * std::exp(angle);
    c.tolerance = round_off(2, steps, size);
    c.plot_x = 0, c.plot_y = 1;
    cases.push_back(c);
  }
  return cases;
}

/// x_i' = a_i cos(w_i t + p_i): the rule reduces to a sum over its nodes.
Case cosine_case(const Rule& rule, Random& random) {
  const int n = 2, steps = 12;
  const double h = random.uniform(0.3, 0.5);
  Case c{call(rule, "cosine"), start(random, n, steps, h), {}, n, 0, "step", "state"};
  VectorXd x(n), a(n), w(n), p(n);
  for (int i = 0; i < n; ++i)
    x[i] = c.in[4 + i], a[i] = random.uniform(1, 2), w[i] = random.uniform(1, 2), p[i] = random.uniform(0, 3);
  put(a, c.in), put(w, c.in), put(p, c.in);
  for (int k = 0; k < steps; ++k) {
    for (const Node& node : rule.nodes) {
      const double t = c.in[2] + (k + node.time) * h;
      x.array() += h * node.weight * a.array() * (w.array() * t + p.array()).cos();
    }
    put(x, c.expected);
  }
  c.tolerance = round_off(n, steps, 2 + steps * h * 2);
  c.plot_y = 0, c.row_size = h;
  return c;
}

template <Rule rule()>
std::vector<Case> time(Random& random) {
  return {cosine_case(rule(), random),
          linear_case(rule(), random, Depends::on_state_and_time, 2, 4, random.uniform(0.2, 0.5))};
}

template <Rule rule()>
std::vector<Case> points(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const double h = random.uniform(0.2, 0.7);
    Case c{call(rule(), "points"), start(random, 2, 1, h), {}, 3, 0, "evaluation", "point"};
    const Linear s = add_linear(random, Depends::on_state_and_time, c.in);
    for (const Stage& stage : rule().stages) {
      c.expected.push_back(c.in[2] + stage.time * h);
      put(apply(stage.polynomial, h * s.m, s.z).head(2), c.expected);
    }
    c.tolerance = round_off(2, 1, s.z.norm() * std::exp(h * s.m.norm()));
    cases.push_back(c);
  }
  return cases;
}

template <Rule rule()>
std::vector<Case> purity(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    Case c = linear_case(rule(), random, Depends::on_state, 2, 1, random.uniform(0.2, 0.7));
    c.call = call(rule(), "twice"), c.row = "try", c.column = "state";
    const Numbers result = c.expected;
    c.expected.insert(c.expected.end(), c.in.begin() + 4, c.in.begin() + 6);
    c.expected.insert(c.expected.end(), result.begin(), result.end());
    cases.push_back(c);
  }
  return cases;
}

template <Rule rule()>
std::vector<Case> sizes(Random& random) {
  std::vector<Case> cases;
  for (const int n : {1, 3, 4, 5, 6, 7, 8})
    cases.push_back(linear_case(rule(), random, Depends::on_state, n, 1, random.uniform(0.2, 0.7)));
  return cases;
}

template <Rule rule()>
std::vector<Case> zero_and_back(Random& random) {
  return {linear_case(rule(), random, Depends::on_state, 2, 1, 0),
          linear_case(rule(), random, Depends::on_state_and_time, 2, 4, -random.uniform(0.2, 0.5))};
}

/// x at the time `to`, from x' = r (1 + cos(w t + p) / 2) x (1 - x): with u = x / (1 - x), the difference
/// ln u - r (t + sin(w t + p) / (2 w)) is constant.
double seasonal_growth(double x, double r, double w, double p, double from, double to) {
  const double grown = r * (to - from + (std::sin(w * to + p) - std::sin(w * from + p)) / (2 * w));
  return 1 / (1 + (1 / x - 1) * std::exp(-grown));
}

/// Returns log2 of the ratio of two errors: the largest one with h and the largest one with h/2, over the whole run.
Found observed_order(const Case& c, const Numbers& raw) {
  const int n = static_cast<int>(c.in[0]), steps = static_cast<int>(c.in[1]);
  if (static_cast<int>(raw.size()) != 2 * n * steps) return raw;  // reported as an answer of the wrong size
  const double *x = &c.in[4], *r = x + n, *w = r + n, *p = w + n;
  double whole = 0, halves = 0;
  for (int k = 0; k < steps; ++k)
    for (int i = 0; i < n; ++i) {
      const double right = seasonal_growth(x[i], r[i], w[i], p[i], c.in[2], c.in[2] + (k + 1) * c.in[3]);
      whole = std::max(whole, std::abs(raw[2 * n * k + i] - right));
      halves = std::max(halves, std::abs(raw[2 * n * k + n + i] - right));
    }
  return Numbers{std::log2(whole / halves)};
}

/// The error is C h^p (1 + O(h)): with the steps below, the last factor changes the order by less than 0.1, and the
/// errors stay a thousand times above round-off.
template <Rule rule()>
std::vector<Case> order(Random& random) {
  const int n = 2, steps = rule().order == 1 ? 400 : rule().order == 2 ? 120 : 100;
  Case c{call(rule(), "halved"), start(random, n, steps, 3. / steps), {}, 1, 0.1, "order", "order"};
  for (int i = 0; i < n; ++i) c.in[4 + i] = random.uniform(0.1, 0.3);
  put_random(random, n, 1, 2, c.in);
  put_random(random, n, 1, 2, c.in);
  put_random(random, n, 0, 3, c.in);
  c.expected = {static_cast<double>(rule().order)};
  return {c};
}

using Tags = std::vector<std::string_view>;

const std::vector<Test>& table() {
  static const Tags step{"one step"}, growth{"growth per step"}, clock{"f(t, x)"}, stages{"stages", "cost"},
      pure{"pure functions"}, size{"systems of any size"}, sign{"sign of h"}, accuracy{"order of accuracy"};
  static const std::vector<Test> tests{
      {"1.1", "euler", 2, 1, step, "Explicit Euler", one_step<euler>, nullptr, points<euler>},
      {"1.2", "euler", 2, 1, growth, "Growth on the circle", circle<euler>, nullptr, points<euler>},
      {"1.3", "euler", 2, 1, clock, "Time", time<euler>, nullptr, points<euler>},
      {"1.4", "euler", 2, 1, stages, "Where f is called", points<euler>},
      {"1.5", "euler", 2, 1, pure, "Pure functions", purity<euler>, nullptr, points<euler>},
      {"1.6", "euler", 2, 1, size, "Any number of numbers", sizes<euler>, nullptr, points<euler>},
      {"1.7", "euler", 2, 1, sign, "Steps of zero and steps back", zero_and_back<euler>, nullptr, points<euler>},
      {"1.8", "euler", 2, 1, accuracy, "Order of accuracy", order<euler>, observed_order, points<euler>},
      {"2.1", "trapezoidal", 3, 1, step, "The trapezoidal rule", one_step<trapezoidal>, nullptr, points<trapezoidal>},
      {"2.2", "trapezoidal", 3, 1, growth, "Growth on the circle", circle<trapezoidal>, nullptr, points<trapezoidal>},
      {"2.3", "trapezoidal", 3, 2, clock, "Time", time<trapezoidal>, nullptr, points<trapezoidal>},
      {"2.4", "trapezoidal", 3, 1, stages, "Where f is called", points<trapezoidal>},
      {"2.5", "trapezoidal", 3, 1, pure, "Pure functions", purity<trapezoidal>, nullptr, points<trapezoidal>},
      {"2.6", "trapezoidal", 3, 1, size, "Any number of numbers", sizes<trapezoidal>, nullptr, points<trapezoidal>},
      {"2.7", "trapezoidal", 3, 1, sign, "Steps of zero and steps back", zero_and_back<trapezoidal>, nullptr,
       points<trapezoidal>},
      {"2.8", "trapezoidal", 3, 2, accuracy, "Order of accuracy", order<trapezoidal>, observed_order,
       points<trapezoidal>},
      {"3.1", "rk4", 4, 1, step, "The classic Runge-Kutta rule", one_step<rk4>, nullptr, points<rk4>},
      {"3.2", "rk4", 4, 1, growth, "Growth on the circle", circle<rk4>, nullptr, points<rk4>},
      {"3.3", "rk4", 4, 2, clock, "Time", time<rk4>, nullptr, points<rk4>},
      {"3.4", "rk4", 4, 1, stages, "Where f is called", points<rk4>},
      {"3.5", "rk4", 4, 1, pure, "Pure functions", purity<rk4>, nullptr, points<rk4>},
      {"3.6", "rk4", 4, 1, size, "Any number of numbers", sizes<rk4>, nullptr, points<rk4>},
      {"3.7", "rk4", 4, 1, sign, "Steps of zero and steps back", zero_and_back<rk4>, nullptr, points<rk4>},
      {"3.8", "rk4", 4, 2, accuracy, "Order of accuracy", order<rk4>, observed_order, points<rk4>},
  };
  return tests;
}

constexpr Part parts[] = {{"euler", "euler.title", "euler_step"},
                          {"trapezoidal", "trapezoidal.title", "trapezoidal_step"},
                          {"rk4", "rk4.title", "rk4_step"}};

}  // namespace

const Assignment& a1_steppers() {
  static const Assignment assignment{"a1-steppers", "Time steppers", parts, table(), nullptr, {}, a1::tableau_text};
  return assignment;
}

}  // namespace coursework
