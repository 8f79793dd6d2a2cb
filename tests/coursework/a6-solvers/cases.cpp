// Forces and tangents are mysim's. The weights, and the errors that remain after passes, are computed from closed forms
// of Chebyshev polynomials. The exact step is mysim's implicit Euler. Averaging's rest state uses a power of a matrix.
#include "tests/coursework/a6-solvers/cases.h"

#include <algorithm>
#include <cmath>

#include "mysim/steppers/steppers.h"

namespace coursework::a6 {

using crosscheck::Points;
using crosscheck::Vec3;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Chebyshev polynomial T_n(s): cos or cosh of n times an angle.
double chebyshev(int n, double s) {
  if (std::abs(s) <= 1) return std::cos(n * std::acos(s));
  return (s < 0 && n % 2 == 1 ? -1 : 1) * std::cosh(n * std::acosh(std::abs(s)));
}

double weight(int pass, double rho) {
  if (pass == 1 || rho == 0) return 1;
  return 2 * chebyshev(pass - 1, 1 / rho) / (rho * chebyshev(pass, 1 / rho));
}

crosscheck::Model model_of(const Scene& s, double stiffness, bool gravity) {
  crosscheck::Model model;
  crosscheck::Particles& p = model.particles;
  p.mass = VectorXd::Constant(s.x.cols(), s.mass);
  p.pinned.assign(s.held.begin(), s.held.end());
  for (int i = 0; i < s.x.cols(); ++i)
    if (s.held[i]) p.pins.push_back(i);
  p.pin_home = s.x(Eigen::all, p.pins);
  std::vector<crosscheck::Spring> springs = s.springs;
  for (auto& spring : springs) spring.k = stiffness;
  model.terms.emplace_back(crosscheck::Springs{springs});
  if (gravity) model.terms.emplace_back(crosscheck::Gravity{s.gravity});
  return model;
}

/// Forces for the given stiffness, with or without gravity; 0 for held particles.
Points forces(const Scene& s, const Points& x, double stiffness, bool gravity) {
  const crosscheck::Model model = model_of(s, stiffness, gravity);
  crosscheck::System system(model);
  crosscheck::State state{0, x, Points::Zero(3, x.cols())};
  Points a(3, x.cols());
  system.acceleration(state, a);
  return s.mass * a;
}

/// Gradient of the implicit equation. `ahead` equals `x` at held particles.
Points gradient(const Scene& s, const Points& ahead, const Points& x) {
  return s.mass / (s.h * s.h) * (x - ahead) - forces(s, x, s.stiffness, true);
}

constexpr double velocity_kept = 0.99;

/// Deviation from rest after a step, divided by the deviation to which velocity alone would lead.
double left_after_step(double mu, double inertia, double rho, int passes) {
  return 1 - (1 - inertia / (1 - mu)) * (1 - left_over(mu, rho, passes));
}

/// Weighted mean of each particle's position and the positions that its springs propose. A spring proposes to move each
/// end by half its stretch, which is the force of a spring of 1/2 N/m.
Points averaged(const Scene& s, const Points& x) {
  Eigen::ArrayXd count = Eigen::ArrayXd::Constant(x.cols(), 0.2);
  for (const auto& spring : s.springs) count[spring.a] += 1, count[spring.b] += 1;
  return x.array() + forces(s, x, 0.5, false).array().rowwise() / count.transpose();
}

void averaging_step(Scene& s, int passes) {
  Points x = s.x;
  for (int i = 0; i < x.cols(); ++i)
    if (!s.held[i]) x.col(i) += s.h * (velocity_kept * s.v.col(i) + s.h * s.gravity);
  for (int k = 0; k < passes; ++k) x = averaged(s, x);
  s.v = (x - s.x) / s.h, s.x = x;
}

// ---- scenes and their numbers

Numbers numbers(const Scene& s) {
  Numbers in = {double(s.x.cols()),      s.mass, s.stiffness, s.gravity[0], s.gravity[1], s.gravity[2],
                double(s.springs.size())};
  for (const auto& spring : s.springs) in.insert(in.end(), {double(spring.a), double(spring.b), spring.rest});
  in.insert(in.end(), s.held.begin(), s.held.end());
  return in;
}

Case about(const char* call, const Scene& s, const char* column, int columns) {
  return {.call = call, .in = numbers(s), .columns = columns, .row = "particle", .column = column};
}

/// Sets the tolerance, which allows for a few dozen roundings of numbers as large as the expected ones.
void compared(Case& c) {
  for (const double value : c.expected) c.tolerance = std::max(c.tolerance, 1e-11 * std::abs(value));
}

/// Particles at distorted corners of a tetrahedron, with springs between all pairs. `held` is the index of the particle
/// that is held, or -1. k h^2 / m is about 5, as in the net of the course.
Scene tangle(Random& random, int count, int held) {
  Scene s;
  s.mass = random.uniform(0.5, 2), s.h = random.uniform(0.02, 0.05);
  s.stiffness = std::round(random.uniform(3, 9) * s.mass / (s.h * s.h));
  s.gravity = random_vector(random, 9);
  s.x.resize(3, count), s.v.resize(3, count);
  const double corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (int i = 0; i < count; ++i) {
    s.held.push_back(i == held);
    s.x.col(i) = Vec3(corners[i][0], corners[i][1], corners[i][2]) + random_vector(random, 0.3);
    s.v.col(i) = s.held[i] ? Vec3(0, 0, 0) : random_vector(random, 2);
    for (int j = 0; j < i; ++j)
      s.springs.push_back(
          {j, i, 0, (s.x.col(i) - s.x.col(j)).norm() * random.uniform(0.7, 1.2), crosscheck::Family::single});
  }
  return s;
}

Case of_pass(const char* call, Random& random, const Scene& s) {
  Points ahead = s.x;
  for (int i = 0; i < s.x.cols(); ++i)
    if (!s.held[i]) ahead.col(i) += random_vector(random, 0.2);
  const bool whole = std::string(call) == "pass.jacobi";
  Case c = about(call, s, whole ? "position" : "gradient", 3);
  c.in.push_back(s.h);
  put(c.in, ahead), put(c.in, s.x);
  const Points g = gradient(s, ahead, s.x);
  put(c.expected, whole ? Points(s.x - g / s.slope()) : g);
  compared(c);
  return c;
}

/// Moves one particle of the scene to the position of another particle.
Scene met(Scene s) {
  s.x.col(1) = s.x.col(2);
  return s;
}

Case of_steps(const char* call, Scene s, int steps, int passes, double rho) {
  const bool averaging = std::string(call) == "averaging.state";
  Case c = about(call, s, "motion", 6);
  put(c.in, s.x), put(c.in, s.v);
  c.in.push_back(s.h);
  if (!averaging) c.in.push_back(rho);
  c.in.insert(c.in.end(), {double(passes), double(steps)});
  for (int k = 0; k < steps; ++k) averaging ? averaging_step(s, passes) : step(s, passes, rho);
  for (int i = 0; i < s.x.cols(); ++i)
    for (const Points* p : {&s.x, &s.v}) put(c.expected, Vec3(p->col(i)));
  compared(c);
  return c;
}

Case of_averaging(const Scene& s) {
  Case c = about("averaging.pass", s, "position", 3);
  put(c.in, s.x), put(c.expected, averaged(s, s.x));
  compared(c);
  return c;
}

struct HangingChain {
  int n;
  double mass, stiffness, rest, gravity, h;
  Case asked(const char* call) const {
    return {call, {double(n), mass, stiffness, rest, gravity, h}, {}, 1, 0, "passes", "stretch"};
  }
};
HangingChain hanging(Random& random) {
  const double mass = random.uniform(0.5, 2), stiffness = std::round(random.uniform(4000, 9000));
  return {random.integer(2, 4),      mass, stiffness, random.uniform(0.2, 0.9), random.uniform(8, 12),
          random.uniform(0.02, 0.05)};
}

}  // namespace

MatrixXd Scene::iteration() const {
  crosscheck::Tangent tangent;
  const crosscheck::Model model = model_of(*this, stiffness, false);
  crosscheck::add_stiffness(model, {0, x, Points::Zero(3, x.cols())}, crosscheck::Curvature::exact, tangent);
  std::vector<int> free;
  for (int i = 0; i < x.size(); ++i)
    if (!held[i / 3]) free.push_back(i);
  const int n = static_cast<int>(free.size());
  MatrixXd k(n, n);
  for (int j = 0; j < n; ++j) {
    Points unit = Points::Zero(3, x.cols()), column = unit;
    unit.data()[free[j]] = 1;
    tangent.add_product(1, 0, unit, column);
    for (int i = 0; i < n; ++i) k(i, j) = column.data()[free[i]];
  }
  return MatrixXd::Identity(n, n) * (1 - mass / (h * h) / slope()) - k / slope();
}

double left_over(double mu, double rho, int passes) {
  return rho == 0 ? std::pow(mu, passes) : chebyshev(passes, mu / rho) / chebyshev(passes, 1 / rho);
}

void step(Scene& s, int passes, double rho) {
  const Points ahead = s.x + s.h * velocity_kept * s.v;
  Points x = ahead, last = ahead;
  for (int k = 1; k <= passes; ++k) {
    const Points next = last + weight(k, rho) * (x - gradient(s, ahead, x) / s.slope() - last);
    last = x, x = next;
  }
  s.v = (x - s.x) / s.h, s.x = x;
}

double growth(double sum, double product) {
  Eigen::Matrix2d step;
  step << sum, -product, 1, 0;
  return Eigen::EigenSolver<Eigen::Matrix2d>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

double step_growth(double mu, double inertia, double rho, int passes) {
  const double q = left_after_step(mu, inertia, rho, passes);
  return growth((1 + velocity_kept) * q, velocity_kept * q);
}

// deviations grow if q is above 1 or below -1 / (1 + 2 c), where c is velocity_kept
bool grows(const VectorXd& mu, double inertia, double rho, int passes) {
  return std::any_of(mu.begin(), mu.end(), [&](double one) {
    const double q = left_after_step(one, inertia, rho, passes);
    return q > 1 + 1e-11 || q < -1 / (1 + 2 * velocity_kept);
  });
}

double diverges_from(const VectorXd& mu, double inertia, int passes) {
  double low = 0, high = 0;
  for (int k = 1; k <= 4000 && !grows(mu, inertia, high, passes); ++k) low = high, high = k / 4000.;
  if (high == 1) return 1;
  while (high - low > 1e-9) {
    const double middle = (low + high) / 2;
    (grows(mu, inertia, middle, passes) ? high : low) = middle;
  }
  return low;
}

Scene square(int side, double width, double rest_of_length) {
  Scene s;
  const double spacing = width / (side - 1);
  s.x.resize(3, side * side), s.v.setZero(3, side * side), s.held.assign(side * side, 0);
  s.held[0] = s.held[side - 1] = 1;
  for (int i = 0; i < side * side; ++i) s.x.col(i) = spacing * Vec3(i % side, 0, i / side);
  for (int i = 0; i < side * side; ++i) {
    const bool right = i % side + 1 < side, down = i / side + 1 < side;
    for (const auto& [there, to] : {std::pair{right, i + 1}, {down, i + side}, {right && down, i + side + 1}})
      if (there)
        s.springs.push_back({i, to, 0, rest_of_length * (s.x.col(i) - s.x.col(to)).norm(), crosscheck::Family::single});
  }
  return s;
}

// ---- pass

std::vector<Case> inertia_alone(Random& random) {
  std::vector<Case> cases;
  for (const bool jacobi : {false, true}) {
    Scene s = tangle(random, 3, 0);
    s.springs.clear();
    cases.push_back(of_pass(jacobi ? "pass.jacobi" : "pass.gradient", random, s));
  }
  return cases;
}
std::vector<Case> gradients(Random& random) {
  return {of_pass("pass.gradient", random, tangle(random, 2, 0)),
          of_pass("pass.gradient", random, tangle(random, 3, -1)),
          of_pass("pass.gradient", random, met(tangle(random, 4, 3)))};
}
std::vector<Case> passes(Random& random) {
  return {of_pass("pass.jacobi", random, tangle(random, 2, 0)), of_pass("pass.jacobi", random, tangle(random, 4, -1))};
}

// ---- step

std::vector<Case> steps(Random& random) {
  const double rho = random.uniform(0.5, 0.95);
  return {
      of_steps("step.state", tangle(random, 2, 0), 1, 1, 0), of_steps("step.state", tangle(random, 2, 0), 1, 2, rho),
      of_steps("step.state", tangle(random, 3, -1), 1, 4, rho), of_steps("step.state", tangle(random, 3, 0), 3, 3, 0)};
}
/// Springs of rest length 0 are linear: passes multiply each eigenvector of the error by a factor, and mysim computes
/// the exact step.
std::vector<Case> falling_errors(Random& random) {
  std::vector<Case> cases;
  for (const double rho : {0., std::round(random.uniform(0.6, 0.9) * 100) / 100}) {
    Scene s = tangle(random, 4, 0);
    for (auto& spring : s.springs) spring.rest = 0;
    Case c = about("step.errors", s, "distance", 1);
    put(c.in, s.x), put(c.in, s.v);
    c.in.insert(c.in.end(), {s.h, rho});
    const crosscheck::Model model = model_of(s, s.stiffness, true);
    crosscheck::System system(model);
    crosscheck::State exact{0, s.x, velocity_kept * s.v};
    crosscheck::Workspace work(exact);
    crosscheck::implicit_euler(system, exact, s.h, work);
    put(c.in, exact.x);
    const Points first = s.x + s.h * velocity_kept * s.v - exact.x;
    const VectorXd error = first.rightCols(3).reshaped();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> kinds(s.iteration());
    for (int n = 1; n <= 128; n *= 2) {
      const auto part = [&](double mu) { return left_over(mu, rho, n); };
      const VectorXd left = kinds.eigenvectors() * (kinds.eigenvalues().unaryExpr(part).asDiagonal() *
                                                    (kinds.eigenvectors().transpose() * error));
      c.expected.push_back(left.reshaped(3, 3).colwise().norm().maxCoeff());
    }
    c.row = "passes", c.tolerance = 1e-8 * first.norm(), c.plot_y = 0;  // allows for the residual of mysim's own solve
    cases.push_back(c);
  }
  return cases;
}

std::vector<Case> rest_by_passes(Random& random) {
  const HangingChain chain = hanging(random);
  Case c = chain.asked("step.rest");
  c.in.push_back(std::round(random.uniform(0.3, 0.5) * 100) / 100);
  c.expected.assign(6, 100), c.tolerance = 1e-6;
  return {c};
}

std::vector<Case> course_net(Random& random) {
  Scene s = square(21, 10, 1);
  s.stiffness = 8000, s.gravity = {0, -9.8, 0}, s.h = 0.0333;
  const int passes = random.integer(8, 40), steps = 20;
  const double rho = random.integer(80, 99) / 100.;
  Case c{"step.net", {21, 10, s.mass, s.stiffness, 9.8, s.h, rho, double(passes), steps}, {}, 3, 0, "step", "position"};
  for (int k = 0; k < steps; ++k) {
    step(s, passes, rho);
    put(c.expected, Vec3(s.x.col(s.x.cols() / 2)));
  }
  c.tolerance = 1e-7, c.plot_y = 1, c.row_size = s.h;
  return {c};
}

// ---- averaging

std::vector<Case> averages(Random& random) {
  return {of_averaging(tangle(random, 2, 0)), of_averaging(tangle(random, 3, -1)),
          of_averaging(met(tangle(random, 4, 0)))};
}
std::vector<Case> averaged_steps(Random& random) {
  return {of_steps("averaging.state", tangle(random, 2, 0), 1, 1, 0),
          of_steps("averaging.state", tangle(random, 3, -1), 3, 2, 0)};
}
/// On a line a pass is linear: it multiplies the displacements y by a matrix B. At rest, a step of n passes does not
/// change y: y = B^n (y + h^2 g).
std::vector<Case> rest_by_averaging(Random& random) {
  const HangingChain chain = hanging(random);
  const int n = chain.n;
  MatrixXd b = MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const double springs = i + 1 < n ? 2 : 1, all = 0.2 + springs;
    b(i, i) = (0.2 + springs / 2) / all;
    if (i > 0) b(i, i - 1) = 0.5 / all;
    if (i + 1 < n) b(i, i + 1) = 0.5 / all;
  }
  Case c = chain.asked("averaging.rest");
  MatrixXd power = b;
  for (int passes = 1; passes <= 32; passes *= 2, power = power * power) {
    const VectorXd pushed = power * VectorXd::Constant(n, chain.h * chain.h * chain.gravity);
    const double depth = (MatrixXd::Identity(n, n) - power).lu().solve(pushed)[n - 1];
    c.expected.push_back(100 * depth * chain.stiffness / (chain.mass * chain.gravity * n * (n + 1) / 2));
  }
  // the stretch of a few millimetres is a difference of depths of a few metres, which are rounded
  c.tolerance = 1e-8 * c.expected[0];
  return {c};
}

}  // namespace coursework::a6
