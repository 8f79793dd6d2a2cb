// Parts, points, and the cases of kick_drift, verlet and rk4. If a misconception predicts a number, this number is the
// last input of the call, so that it can be shown next to the correct value.
#include <cmath>
#include <numbers>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/m1-misconceptions/cases.h"

namespace coursework {
namespace {

// ---- kick_drift: closed forms of both maps

struct Oscillator {
  double omega, h, x, v;
  double angle() const { return h * omega; }
  Numbers numbers() const { return {omega, h, x, v}; }
  double energy() const { return v * v + omega * omega * x * x; }
};

Oscillator oscillator(Random& random, double low, double high) {
  const double omega = random.uniform(2, 9), angle = random.uniform(low, high);
  return {omega, angle / omega, random.uniform(0.2, 0.9), random.uniform(1, 5) * (random.integer(0, 1) ? 1 : -1)};
}

/// x, v after `steps` steps of semi-implicit Euler. The matrix M of a step has determinant 1 and trace 2 - a^2, so that
/// it rotates by theta with cos(theta) = 1 - a^2/2, and M^n = (sin(n theta) M - sin((n - 1) theta)) / sin(theta).
std::pair<double, double> after(const Oscillator& o, int steps) {
  const double a = o.angle(), theta = std::acos(1 - a * a / 2);
  const double of_m = std::sin(steps * theta) / std::sin(theta),
               of_1 = -std::sin((steps - 1) * theta) / std::sin(theta);
  const double ww = o.omega * o.omega;
  return {of_m * ((1 - a * a) * o.x + o.h * o.v) + of_1 * o.x, of_m * (o.v - o.h * ww * o.x) + of_1 * o.v};
}

std::vector<Case> one_step(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 3; ++i) {
    const Oscillator o = oscillator(random, 0.1, 0.9);
    Case c{"kick_drift.step", o.numbers(), {}, 2, 0, "order", "swing"};
    const double kicked = o.v - o.angle() * o.omega * o.x;
    const auto [x, v] = after(o, 1);
    c.expected = {o.x + o.h * o.v, kicked, x, v};
    c.tolerance = 1e-13 * std::sqrt(o.energy()) * 10;  // the closed form divides by sin(theta), which may be 0.1
    cases.push_back(c);
  }
  return cases;
}

/// The energy that a misconception predicts, relative to the start: the drift uses the mean of both velocities.
double with_mean_velocity(const Oscillator& o, int steps) {
  Oscillator now = o;
  for (int i = 0; i < steps; ++i) {
    const double kick = -o.h * o.omega * o.omega * now.x;
    now.x += o.h * (now.v + kick / 2), now.v += kick;
  }
  return now.energy() / o.energy();
}

/// Energies of both rules. With the old velocity, a step multiplies the energy by exactly 1 + a^2. With the new
/// velocity, the energy stays near its initial value.
std::vector<Case> energy_of_both(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const Oscillator o = oscillator(random, 0.03, 0.06);
    Case c{"kick_drift.energy", o.numbers(), {}, 2, 0, "hundred", "energy"};
    const double growth = 1 + o.angle() * o.angle();
    for (int steps = 100; steps <= 1000; steps += 100) {
      const auto [x, v] = after(o, steps);
      c.expected.push_back(std::pow(growth, steps));
      c.expected.push_back((v * v + o.omega * o.omega * x * x) / o.energy());
    }
    const double of_old = std::pow(growth, 1000);
    c.in.insert(c.in.end(), {of_old, with_mean_velocity(o, 1000)});
    // allows for ten roundings of values up to the largest energy in each of a thousand steps, and for the error of
    // theta, which is eps / a
    c.tolerance = (1e4 + 1000 / o.angle()) * 1.2e-16 * of_old;
    c.plot_y = 1, c.row_size = 100 * o.h;
    cases.push_back(c);
  }
  return cases;
}

/// The invariant of semi-implicit Euler along a run, written with the next velocity: (v v' + (omega x)^2) / 2.
std::vector<Case> kept_energy(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const Oscillator o = oscillator(random, 0.3, 1.5);
    Case c{"kick_drift.kept", {o.omega, o.h}, {}, 1, 0, "state", "kept"};
    for (const int steps : {0, 1, 2, 7, 50}) {
      const auto [x, v] = after(o, steps);
      c.in.insert(c.in.end(), {x, v});
      c.expected.push_back((o.v * after(o, 1).second + o.omega * o.omega * o.x * o.x) / 2);
    }
    c.tolerance = 1e-12 * o.energy();  // errors of eps / sin(theta) in each of fifty angles, and a dozen roundings
    cases.push_back(c);
  }
  return cases;
}

// ---- verlet: parabolas, and the closed form of the rule on a spring

/// Steps along x(t) = now + u t + a t^2 / 2, for which the rule is exact.
std::vector<Case> next_position(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 3; ++i) {
    const double h = random.uniform(0.1, 0.9), a = -random.uniform(2, 9), u = random.uniform(1, 5),
                 now = random.uniform(1, 5);
    Case c{"verlet.next", {h, a, now - u * h + a * h * h / 2, now}, {now + u * h + a * h * h / 2}, 1, 1e-13};
    c.row = "step", c.column = "position";  // the tolerance allows for a dozen roundings of numbers below 20
    cases.push_back(c);
  }
  return cases;
}

/// Orders of two errors: the error of one step, and the error at a time of 4 to 5 / omega, where a cosine with a
/// small phase error is not close to zero. With a = h omega, the error after this time is C a^2 (1 + O(a / 4)), which
/// changes the order by less than 0.05 for a below 0.12. The error of one step is C a^4 (1 + O(a^2)).
std::vector<Case> both_orders(Random& random) {
  std::vector<Case> cases;
  for (const double halvings : {2, 1, 3}) {
    const double omega = random.uniform(2, 9), a = random.uniform(0.08, 0.12);
    const double steps = std::round(random.uniform(4, 5) / a);
    Case c{"verlet.orders",
           {omega, a / omega, steps, random.uniform(1, 3), random.uniform(0.05, 0.2), halvings},
           {4, 2},
           2,
           0.05};
    c.row = "run", c.column = "orders";
    cases.push_back(c);
  }
  // errors decrease by a different factor each time; the order is the mean, which follows from the first and the last
  for (const int count : {2, 3, 5}) {
    Numbers errors = {random.uniform(1, 3)};
    while (errors.size() < static_cast<std::size_t>(count)) errors.push_back(errors.back() / random.uniform(2, 9));
    Case c{"verlet.observed", {double(count)}, {std::log2(errors[0] / errors.back()) / (count - 1)}, 1, 1e-12};
    c.in.insert(c.in.end(), errors.begin(), errors.end());
    c.row = "run", c.column = "order";
    cases.push_back(c);
  }
  return cases;
}

/// The error of the rule after `steps` steps from x = 1 and the exact next position. A step of this rule, too, rotates
/// by theta with cos(theta) = 1 - a^2/2.
double verlet_error(double a, double steps) {
  const double theta = std::acos(1 - a * a / 2);
  const double sine = (std::cos(a) - std::cos(theta)) / std::sin(theta);
  return std::abs(std::cos(steps * theta) + sine * std::sin(steps * theta) - std::cos(steps * a));
}

/// Cases whose expected answer is the actual error, from the closed form. The actual error differs from the
/// estimate, (given error) / times^2, by a term of the next order in a, at most 3 % for a below 0.06.
std::vector<Case> smaller_steps(Random& random) {
  std::vector<Case> cases;
  for (const int times : {2, 4, 10}) {
    const double omega = random.uniform(2, 9), a = random.uniform(0.03, 0.06);
    const double steps = std::round(random.uniform(4, 5) / a), error = verlet_error(a, steps);
    Case c{"verlet.predicted", {omega, a / omega, steps, error, double(times), error / std::pow(times, 4)}, {}, 1};
    c.expected = {verlet_error(a / times, steps * times)};
    c.tolerance = 0.03 * c.expected[0], c.row = "run", c.column = "error";
    cases.push_back(c);
  }
  return cases;
}

// ---- rk4: on a spring its step is the series of cos and sin up to the fourth power

struct Turned {
  double cosine, sine;
  explicit Turned(double a) : cosine(1 - a * a / 2 + std::pow(a, 4) / 24), sine(a - std::pow(a, 3) / 6) {}
  double energy() const { return cosine * cosine + sine * sine; }
};

std::vector<Case> rk4_steps(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 3; ++i) {
    const Oscillator o = oscillator(random, 0.5, 1.5);
    const Turned turned(o.angle());
    Case c{"rk4.step", o.numbers(), {}, 2, 1e-13 * std::sqrt(o.energy()) * 10,
           "state",    "swing"};  // two dozen roundings
    c.expected = {turned.cosine * o.x + turned.sine * o.v / o.omega, turned.cosine * o.v - turned.sine * o.omega * o.x};
    cases.push_back(c);
  }
  return cases;
}
/// RK4 loses energy if h omega is below 2.828, and gains energy above this value.
std::vector<Case> rk4_energies(Random& random) {
  std::vector<Case> cases;
  for (const auto& [low, high] : {std::pair{0.4, 0.7}, std::pair{2.826, 2.828}, std::pair{2.829, 2.831}}) {
    const Oscillator o = oscillator(random, low, high);
    Case c{"rk4.energy", o.numbers(), {}, 1, 0, "hundred", "energy_of_rk4"};
    const double factor = Turned(o.angle()).energy();
    c.in.push_back(std::pow(2 - factor, 1000));
    for (int steps = 100; steps <= 1000; steps += 100) {
      c.expected.push_back(std::pow(factor, steps));
      c.tolerance = std::max(c.tolerance, 1e-10 * c.expected.back());  // for a thousand steps of two dozen roundings
    }
    c.plot_y = 0, c.row_size = 100 * o.h;
    cases.push_back(c);
  }
  return cases;
}
std::vector<Case> rk4_limits(Random& random) {
  Case factor{"rk4.factor", {}, {}, 1, 1e-11, "step", "factor"},
      largest{"rk4.largest", {}, {}, 1, 1e-11, "spring", "h"};
  for (const double about : {0.5, 1.5, 2.7, 3.0}) {
    const double angle = about * random.uniform(0.95, 1.04), omega = random.uniform(2, 9);
    factor.in.push_back(angle), factor.expected.push_back(Turned(angle).energy());
    largest.in.push_back(omega), largest.expected.push_back(2 * std::numbers::sqrt2 / omega);
  }
  return {factor, largest};
}

constexpr Part parts[] = {{"kick_drift", "kick_drift.title"},
                          {"verlet", "verlet.title"},
                          {"sag", "sag.title"},
                          {"iterations", "iterations.title"},
                          {"rk4", "rk4.title"}};

const Test tests[] = {
    {"1.1", "kick_drift", 3, 2, {"semi-implicit Euler"}, "Kick and drift", one_step},
    {"1.2", "kick_drift", 5, 4, {"semi-implicit Euler", "energy"}, "A thousand steps", energy_of_both},
    {"1.3", "kick_drift", 3, 3, {"semi-implicit Euler", "conservation"}, "What is kept", kept_energy},
    {"2.1", "verlet", 3, 2, {"Verlet"}, "Position Verlet", next_position},
    {"2.2", "verlet", 4, 4, {"Verlet", "order"}, "Order of a step, order of a run", both_orders},
    {"2.3", "verlet", 4, 3, {"Verlet", "order"}, "A smaller step", smaller_steps},
    {"3.1", "sag", 4, 4, {"catenary"}, "A chain in its own weight", m1::catenaries},
    {"3.2", "sag", 3, 3, {"parabola"}, "A bridge on a cable", m1::parabolas},
    {"3.3", "sag", 3, 3, {"catenary", "elasticity"}, "A chain that stretches", m1::elastic_chains},
    {"4.1", "iterations", 3, 2, {"position-based dynamics"}, "A frame by a plan", m1::frames},
    {"4.2", "iterations", 3, 2, {"position-based dynamics", "iterations"}, "Where iterations lead", m1::many},
    {"4.3", "iterations", 3, 2, {"measuring"}, "Measure, then choose", m1::tables},
    {"4.4", "iterations", 3, 2, {"measuring", "iterations"}, "Measure, then choose", m1::measured},
    {"5.1", "rk4", 3, 3, {"RK4"}, "Four slopes", rk4_steps},
    {"5.2", "rk4", 4, 3, {"RK4", "energy"}, "The energy of RK4", rk4_energies},
    {"5.3", "rk4", 4, 3, {"RK4", "stability"}, "The energy of RK4", rk4_limits},
};

}  // namespace

const Assignment& m1_misconceptions() {
  static const Assignment assignment{"m1-misconceptions", "Five beliefs", parts, tests};
  return assignment;
}

}  // namespace coursework
