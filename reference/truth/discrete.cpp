#include "reference/truth/discrete.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mysim/base/errors.h"

namespace crosscheck {

// Amplification matrices. With g = drag + dashpot, every rule is applied to u' = v, v' = push - w2 u - g v. The rows
// are the increments of u and v in a step, as multiples of (u, v, 1).

namespace {

using RowVector = Eigen::RowVector3d;

const RowVector velocity_row(0, 1, 0);

Eigen::Matrix3d system_of(const Mode& m) {
  Eigen::Matrix3d a;
  a << 0, 1, 0, -m.omega2, -(m.drag + m.dashpot), m.forcing, 0, 0, 0;
  return a;
}

Increment increment_from_rows(const RowVector& u_gains, const RowVector& v_gains) {
  Increment e = Increment::Zero();
  e.row(0) = u_gains;
  e.row(1) = v_gains;
  return e;
}

/// Runge-Kutta rules up to order 4: the Taylor polynomial of exp(h A) whose degree is the rule's order.
template <int order>
Increment taylor_increment(const Eigen::Matrix3d& a, double h) {
  Increment sum = Increment::Zero(), term = Increment::Identity();
  for (int i = 1; i <= order; ++i) {
    term = term * a * (h / i);
    sum += term;
  }
  return sum;
}
template <int order>
Increment taylor_increment_of_mode(const Mode& m, double h) {
  return taylor_increment<order>(system_of(m), h);
}

/// v += h a(u, v), then u += h v.
Increment symplectic_euler_increment(const Mode& m, double h) {
  const RowVector gain = h * system_of(m).row(1);
  return increment_from_rows(h * (velocity_row + gain), gain);
}

/// u_m = u + h v / 2. The kick evaluates drag at the mean of old and new velocity, dashpots at v in the first pass, and
/// later at the mean of v and the previous pass's result. Then u' = u_m + h v' / 2.
template <int passes>
Increment leapfrog_increment(const Mode& m, double h) {
  const RowVector force(-m.omega2, -m.omega2 * h / 2, m.forcing);
  RowVector gain = RowVector::Zero();
  for (int pass = 0; pass < passes; ++pass)
    gain = h * (force - m.dashpot * (velocity_row + gain / 2) - m.drag * velocity_row) / (1 + h * m.drag / 2);
  return increment_from_rows(h * velocity_row + h / 2 * gain, gain);
}

/// One step followed by another: (I + then)(I + first) - I.
Increment compose(const Increment& first, const Increment& then) { return first + then + then * first; }

/// Leapfrog steps of p h, p h, (1 - 4 p) h, p h, p h, with p = 1 / (4 - 4^(1/3)).
Increment suzuki4_increment(const Mode& m, double h) {
  const double p = 1 / (4 - std::cbrt(4.0));
  const Increment outer = leapfrog_increment<4>(m, p * h), pair = compose(outer, outer);
  return compose(compose(pair, leapfrog_increment<4>(m, (1 - 4 * p) * h)), pair);
}

/// v' = v + h (push - w2 u' - g v'), u' = u + h v', solved for the gain of v.
Increment implicit_euler_increment(const Mode& m, double h) {
  const double g = m.drag + m.dashpot;
  const RowVector gain = h * RowVector(-m.omega2, -g - h * m.omega2, m.forcing) / (1 + h * g + h * h * m.omega2);
  return increment_from_rows(h * (velocity_row + gain), gain);
}

/// The midpoint is an implicit Euler step of h / 2; the full step is twice its increment.
Increment implicit_midpoint_increment(const Mode& m, double h) { return 2 * implicit_euler_increment(m, h / 2); }

/// A free step with implicit drag and dashpot, then the spring's correction of the position, with u measured from the
/// unstretched length. Without a dashpot this is implicit Euler.
Increment xpbd_increment(const Mode& m, double h) {
  const RowVector free_gain = h * RowVector(0, -(m.drag + m.dashpot), m.forcing) / (1 + h * (m.drag + m.dashpot));
  const double s = h * h * m.omega2 / (1 + h * m.drag);
  const RowVector correction = -s / (1 + s) * (RowVector(1, 0, 0) + h * (velocity_row + free_gain));
  return increment_from_rows(h * (velocity_row + free_gain) + correction, free_gain + correction / h);
}

}  // namespace

std::span<const DiscreteStepper> discrete_steppers() {
  static constexpr DiscreteStepper table[] = {
      {"explicit-euler", taylor_increment_of_mode<1>, taylor_increment<1>},
      {"trapezoidal", taylor_increment_of_mode<2>, taylor_increment<2>},
      {"rk4", taylor_increment_of_mode<4>, taylor_increment<4>},
      {"symplectic-euler", symplectic_euler_increment, nullptr},
      {"leapfrog", leapfrog_increment<2>, nullptr},
      {"suzuki4", suzuki4_increment, nullptr},
      {"implicit-euler", implicit_euler_increment, nullptr},
      {"implicit-midpoint", implicit_midpoint_increment, nullptr},
      {"xpbd", xpbd_increment, nullptr, true},
  };
  return table;
}

Increment increment_power(Increment e, long n) {
  Increment power = Increment::Zero();
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) power = compose(power, e);
    e = compose(e, e);
  }
  return power;
}

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Growth of errors in (u, v), with velocities divided by omega.
double amplification_of(const Increment& power, double omega) {
  Eigen::Matrix2d m = power.topLeftCorner<2, 2>() + Eigen::Matrix2d::Identity();
  m(0, 1) *= omega, m(1, 0) /= omega;
  // larger singular value: half the sum of the norms of the conformal and the anticonformal part of m
  return (std::hypot(m(0, 0) + m(1, 1), m(0, 1) - m(1, 0)) + std::hypot(m(0, 0) - m(1, 1), m(0, 1) + m(1, 0))) / 2;
}

Truth empty_truth(const DiscreteStepper& rule, double h) {
  return {Tier::exact_discrete,
          fmt::format("powers of the amplification matrix of {} at h = {:.6g} s", rule.name, h),
          {},
          0};
}

Truth rotation_truth(const DiscreteStepper& rule, const Scene& scene, const TimeGrid& steps, double rate) {
  if (!rule.of_system)
    throw Unsupported("the scene is a first-order system x' = f(x, t), but this rule needs positions and velocities");
  Truth truth = empty_truth(rule, steps.h);
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  a(0, 1) = -rate, a(1, 0) = rate;
  const Increment step = rule.of_system(a, steps.h);
  for (int sample = 0; sample <= steps.samples; ++sample) {
    const long n = static_cast<long>(sample) * steps.steps_per_sample;
    truth.trajectory.t.push_back(steps.time(sample, 0));
    truth.trajectory.x.push_back(scene.start.x + increment_power(step, n) * scene.start.x);  // z is unchanged
    truth.trajectory.v.push_back(scene.start.v);
    truth.error_bar = std::max(truth.error_bar, 4 * eps * static_cast<double>(n) * truth.trajectory.x.back().norm());
  }
  return truth;
}

/// Largest sum(k) / m of a free particle, 1/s^2.
double stiffest(const Model& model) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(model.particles.size());
  if (const auto* springs = model.find<Springs>())
    for (const Spring& s : springs->list) sum[s.a] += s.k, sum[s.b] += s.k;
  for (int pin : model.particles.pins) sum[pin] = 0;
  return (sum.array() / model.particles.mass.array()).maxCoeff();
}

}  // namespace

Truth discrete_truth(const DiscreteStepper& rule, const Scene& scene, const Run& run) {
  const Model& model = scene.model;
  const TimeGrid steps = time_grid(run);
  if (const auto* rotation = model.find<Rotation>()) return rotation_truth(rule, scene, steps, rotation->rate);
  const auto linear = linear_scene(scene);
  if (!linear) throw Unsupported("the scene is not linear: closed forms require a step that is a matrix product");
  if (model.particles.move) throw Unsupported("the pins move, but closed forms of rules require pins at rest");
  const auto* springs = model.find<Springs>();
  const auto* dashpots = model.find<Dashpots>();
  if (rule.one_spring && ((springs && springs->list.size() > 1) || (dashpots && dashpots->list.size() > 1)))
    throw Unsupported("this rule sweeps the springs one by one: it has a closed form for a single spring only");

  Truth truth = empty_truth(rule, steps.h);
  std::vector<Increment> step_increment;
  std::vector<double> omega;  // 1/s, converts errors in velocity to errors in position
  for (const Mode& m : linear->modes) {
    step_increment.push_back(rule.of_mode(m, steps.h));
    omega.push_back(std::max(std::sqrt(m.omega2), 1 / run.duration));
  }
  double growth = 1, farthest = 0, fastest = 0;
  std::vector<double> centre(step_increment.size(), 0), amplitude(step_increment.size(), 0);
  for (int sample = 0; sample <= steps.samples; ++sample) {
    State s = scene.start;
    const long n = static_cast<long>(sample) * steps.steps_per_sample;
    for (size_t i = 0; i < step_increment.size(); ++i) {
      const Mode& m = linear->modes[i];
      const Increment power = increment_power(step_increment[i], n);
      const Eigen::Vector3d gained = power * Eigen::Vector3d(m.u0, m.v0, 1);
      s.x += gained[0] * m.shape;
      s.v += gained[1] * m.shape;
      growth = std::max(growth, amplification_of(power, omega[i]));
      if (m.omega2 == 0) continue;
      centre[i] = m.forcing / m.omega2;
      amplitude[i] = std::hypot(m.u0 + gained[0] - centre[i], (m.v0 + gained[1]) / omega[i]);
    }
    const double t = steps.time(sample, 0);
    if (!(linear->shortest_spring_length(model, centre, amplitude) > 0))
      throw Unsupported(fmt::format("at {:.4g} s a spring may turn over, which makes its law nonlinear", t));
    farthest = std::max(farthest, largest_column(s.x));
    fastest = std::max(fastest, largest_column(s.v));
    truth.trajectory.t.push_back(t);
    truth.trajectory.x.push_back(std::move(s.x));
    truth.trajectory.v.push_back(std::move(s.v));
  }
  const double in_velocity = fastest + steps.h * stiffest(model) * farthest;
  truth.error_bar = 4 * eps * steps.samples * static_cast<double>(steps.steps_per_sample) * growth *
                    (farthest + in_velocity / *std::min_element(omega.begin(), omega.end()));
  return truth;
}

}  // namespace crosscheck
