// Expected answers are closed forms for motion on a line and for free fall, and mysim's own implicit Euler for linear
// forces. Otherwise Eigen solves a dense system of mysim's forces and tangents.
#include "tests/coursework/a5-stiff/tests_motion.h"

#include <Eigen/Dense>
#include <algorithm>

#include "mysim/steppers/steppers.h"
#include "tests/coursework/grader/vectors.h"

namespace coursework::a5 {
namespace {

using crosscheck::Points;
using crosscheck::Vec3;

struct Scene {
  Points x, v;
  std::vector<double> mass;
  std::vector<int> fixed;  // 0 or 1 each
  std::vector<crosscheck::Spring> springs;
  Vec3 gravity = Vec3::Zero();
  double drag = 0, h = 0;
  int size() const { return static_cast<int>(mass.size()); }
};

Numbers inputs(const Scene& s, int steps) {
  Numbers in = {double(s.size()), double(steps), s.h,          s.drag,
                s.gravity[0],     s.gravity[1],  s.gravity[2], double(s.springs.size())};
  for (const auto& spring : s.springs) in.insert(in.end(), {double(spring.a), double(spring.b), spring.k, spring.rest});
  in.insert(in.end(), s.mass.begin(), s.mass.end());
  in.insert(in.end(), s.fixed.begin(), s.fixed.end());
  put(in, s.x), put(in, s.v);
  return in;
}

void add_row(const Scene& s, int i, Numbers& out) {
  for (const Points* p : {&s.x, &s.v}) put(out, Vec3(p->col(i)));
}

/// Tolerance, relative to the largest number. A step solves a well-conditioned system (each case says why), so that it
/// loses only a few of sixteen digits, and damping keeps the errors of different steps from adding up. 1e-9 therefore
/// allows for any order of summation.
constexpr double accuracy = 1e-9;

Case watched(const Scene& start, int steps, int particle, void (*step)(Scene&)) {
  Case c;
  c.call = "implicit_euler.watch";
  c.in = inputs(start, steps);
  c.in.push_back(particle);
  Scene s = start;
  for (int i = 0; i < steps; ++i) {
    step(s);
    add_row(s, particle, c.expected);
  }
  c.columns = 6, c.row = "step", c.column = "motion", c.row_size = start.h;
  for (const double value : c.expected) c.tolerance = std::max(c.tolerance, accuracy * std::abs(value));
  // the plot shows the component with the largest range
  double widest = -1;
  for (int part = 0; part < 3; ++part) {
    double low = c.expected[part], high = low;
    for (size_t at = part; at < c.expected.size(); at += 6)
      low = std::min(low, c.expected[at]), high = std::max(high, c.expected[at]);
    if (high - low > widest) widest = high - low, c.plot_y = part;
  }
  return c;
}

struct Mysim {
  crosscheck::Model model;
  crosscheck::State state;
};
Mysim as_mysim(const Scene& s) {
  Mysim m;
  crosscheck::Particles& p = m.model.particles;
  p.mass = Eigen::Map<const Eigen::VectorXd>(s.mass.data(), s.size());
  p.pinned.assign(s.fixed.begin(), s.fixed.end());
  for (int i = 0; i < s.size(); ++i)
    if (s.fixed[i]) p.pins.push_back(i);
  p.pin_home.resize(3, static_cast<int>(p.pins.size()));
  for (size_t i = 0; i < p.pins.size(); ++i) p.pin_home.col(static_cast<int>(i)) = s.x.col(p.pins[i]);
  m.model.terms.emplace_back(crosscheck::Springs{s.springs, crosscheck::SpringLaw::hooke});
  m.model.terms.emplace_back(crosscheck::Gravity{s.gravity});
  m.model.terms.emplace_back(crosscheck::Drag{Eigen::VectorXd::Constant(s.size(), s.drag)});
  m.state = {0, s.x, s.v};
  return m;
}

/// mysim's implicit Euler step, by Newton's method. It equals linearised_step() if forces are linear in the positions.
void whole_step(Scene& s) {
  Mysim m = as_mysim(s);
  crosscheck::System f(m.model);
  crosscheck::Workspace w(m.state);
  crosscheck::implicit_euler(f, m.state, s.h, w);
  s.x = m.state.x, s.v = m.state.v;
}

/// Solves (M + h C + h^2 K) dv = h (F - h K v) for the free particles.
void linearised_step(Scene& s) {
  Mysim m = as_mysim(s);
  crosscheck::System f(m.model);
  Points a(3, s.size());
  f.acceleration(m.state, a);
  crosscheck::Tangent tangent;
  crosscheck::add_stiffness(m.model, m.state, crosscheck::Curvature::exact, tangent);
  auto times_k = [&](const Points& d) {
    Points out = Points::Zero(3, s.size());
    tangent.add_product(1, 0, d, out);
    return out;
  };
  std::vector<int> moving;
  for (int i = 0; i < 3 * s.size(); ++i)
    if (!s.fixed[i / 3]) moving.push_back(i);
  const int n = static_cast<int>(moving.size());
  Eigen::MatrixXd matrix(n, n);
  Eigen::VectorXd right(n);
  const Points kv = times_k(s.v);
  for (int j = 0; j < n; ++j) {
    Points unit = Points::Zero(3, s.size());
    unit.data()[moving[j]] = 1;
    const Points column = times_k(unit);
    for (int i = 0; i < n; ++i) matrix(i, j) = s.h * s.h * column.data()[moving[i]];
    const double mass = s.mass[moving[j] / 3];
    matrix(j, j) += mass + s.h * s.drag;
    right[j] = s.h * (mass * a.data()[moving[j]] - s.h * kv.data()[moving[j]]);
  }
  const Eigen::VectorXd dv = matrix.fullPivLu().solve(right);
  for (int j = 0; j < n; ++j) {
    s.v.data()[moving[j]] += dv[j];
    s.x.data()[moving[j]] += s.h * s.v.data()[moving[j]];
  }
}

/// Motion along the line through both ends, where the spring is linear. With the stretch e = L - r, the step is
/// v' = (v - h w^2 e) / (1 + (h w)^2), e' = e + h v'.
void oscillator_step(Scene& s) {
  const crosscheck::Spring& spring = s.springs[0];
  const int free = s.fixed[0] ? 1 : 0;
  const Vec3 d = s.x.col(free) - s.x.col(1 - free), u = d.normalized();
  const double w2 = spring.k / s.mass[free], e = d.norm() - spring.rest, v = s.v.col(free).dot(u);
  s.v.col(free) = u * (v - s.h * w2 * e) / (1 + s.h * s.h * w2);
  s.x.col(free) += s.h * s.v.col(free);
}

/// v' = (v + h g) / (1 + h c / m).
void falling_step(Scene& s) {
  for (int i = 0; i < s.size(); ++i) {
    s.v.col(i) = (s.v.col(i) + s.h * s.gravity) / (1 + s.h * s.drag / s.mass[i]);
    s.x.col(i) += s.h * s.v.col(i);
  }
}

/// n particles on a line, of which the first and last are fixed. Each spring is longer than its rest length.
Scene chain(Random& random, double rest_of_length, int n = 6) {
  Scene s;
  s.x.resize(3, n), s.v.setZero(3, n);
  const Vec3 start = random_vector(random, 1), along = random_direction(random) * random.uniform(0.3, 0.6);
  for (int i = 0; i < n; ++i) {
    s.x.col(i) = start + i * along;
    s.mass.push_back(random.uniform(0.2, 0.6));
    s.fixed.push_back(i == 0 || i == n - 1);
    if (!s.fixed[i]) s.v.col(i) = random_vector(random, 1);
    if (i > 0) s.springs.push_back({i, i - 1, random.uniform(1000, 4000), along.norm() * rest_of_length});
  }
  s.gravity = random_direction(random) * random.uniform(5, 15);
  s.drag = random.uniform(0.5, 2);
  s.h = random.uniform(0.03, 0.1);
  return s;
}

}  // namespace

std::vector<Case> one_spring(Random& random) {
  std::vector<Case> cases;
  for (const double long_step : {0.5, 8.0, 40.0}) {
    Scene s;
    const double mass = random.uniform(0.3, 3), rest = random.uniform(0.5, 1.5), k = random.uniform(500, 5000);
    const double omega = std::sqrt(k / mass);
    s.h = long_step * random.uniform(0.8, 1.25) / omega;
    const int fixed = random.integer(0, 1);
    const Vec3 u = random_direction(random);
    s.x.resize(3, 2), s.v.setZero(3, 2);
    s.x.col(fixed) = random_vector(random, 1);
    // the particle has too little energy to reach the fixed end
    s.x.col(1 - fixed) = s.x.col(fixed) + u * rest * random.uniform(1.2, 1.4);
    s.v.col(1 - fixed) = u * rest * omega * random.uniform(0.2, 0.4) * (random.integer(0, 1) ? 1 : -1);
    s.mass = {mass, mass}, s.fixed = {fixed == 0, fixed == 1};
    s.springs = {{0, 1, k, rest, crosscheck::Family::single}};
    // the step is well conditioned: its only divisor is 1 + (h omega)^2
    cases.push_back(watched(s, long_step < 1 ? 25 : 6, 1 - fixed, oscillator_step));
  }
  return cases;
}

std::vector<Case> gravity_and_drag(Random& random) {
  Scene s;
  s.mass = {random.uniform(0.2, 0.5), random.uniform(2, 4)}, s.fixed = {0, 0};
  s.x.resize(3, 2), s.v.resize(3, 2);
  for (int i = 0; i < 2; ++i) s.x.col(i) = random_vector(random, 2), s.v.col(i) = random_vector(random, 3);
  s.gravity = random_direction(random) * random.uniform(5, 12);
  s.drag = random.uniform(1, 3), s.h = random.uniform(0.1, 0.5);
  // the step is well conditioned: its matrix is diagonal
  return {watched(s, 12, 0, falling_step), watched(s, 12, 1, falling_step)};
}

namespace {

/// Springs between `count` corners of a tetrahedron.
Case network_of(Random& random, int count) {
  Scene s;
  s.h = random.uniform(0.02, 0.1), s.drag = random.uniform(0.5, 3);
  s.gravity = random_direction(random) * random.uniform(5, 12);
  s.x.resize(3, count), s.v.resize(3, count);
  // the tetrahedron is distorted, but no two particles coincide
  const double corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (int i = 0; i < count; ++i) {
    s.x.col(i) = Vec3(corners[i][0], corners[i][1], corners[i][2]) + random_vector(random, 0.3);
    s.v.col(i) = random_vector(random, 2);
    s.mass.push_back(random.uniform(0.5, 2)), s.fixed.push_back(0);
    for (int j = 0; j < i; ++j) {
      // springs that are shortened by at most a tenth subtract at most 4 h^2 k / 10 < m / 2 from the matrix, so that
      // its condition number is below a hundred
      const double length = (s.x.col(i) - s.x.col(j)).norm(), k = random.uniform(0.5, 1.25) * 0.5 / (s.h * s.h);
      s.springs.push_back({i, j, k, length * random.uniform(0.6, 1.1), crosscheck::Family::single});
    }
  }
  Case c;
  c.call = "implicit_euler.all";
  c.in = inputs(s, 1);
  linearised_step(s);
  for (int i = 0; i < count; ++i) add_row(s, i, c.expected);
  for (const double value : c.expected) c.tolerance = std::max(c.tolerance, accuracy * std::abs(value));
  c.columns = 6, c.row = "particle", c.column = "motion";
  return c;
}

}  // namespace

// two networks of different size, because a solution must not keep state between calls
std::vector<Case> network(Random& random) { return {network_of(random, 4), network_of(random, 3)}; }
std::vector<Case> small_network(Random& random) { return {network_of(random, 1), network_of(random, 2)}; }

std::vector<Case> stiff_chain(Random& random) {
  // springs are only stretched, so that the condition number is at most about 1 + 4 h^2 k / m, below a thousand
  const Scene threads = chain(random, 0), springs = chain(random, random.uniform(0.8, 0.95));
  return {watched(threads, 15, random.integer(1, 4), whole_step),
          watched(springs, 15, random.integer(1, 4), linearised_step)};
}

// a single step of one moving particle between two fixed particles
std::vector<Case> small_stiff_chain(Random& random) {
  return {watched(chain(random, 0, 3), 1, 1, whole_step), watched(chain(random, 0.8, 3), 1, 1, linearised_step)};
}

}  // namespace coursework::a5
