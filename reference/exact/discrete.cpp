// Powers of amplification matrices, put together to the states of a scene.
#include "reference/exact/discrete.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mysim/errors.h"

namespace crosscheck {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// What errors in (u, v) grow by, velocities weighed with 1 / omega.
double growth_of(const Increment& power, double omega) {
  Eigen::Matrix2d m = power.topLeftCorner<2, 2>() + Eigen::Matrix2d::Identity();
  m(0, 1) *= omega, m(1, 0) /= omega;
  // the larger singular value of a 2 x 2 matrix: half the sum of the lengths of its conformal and anticonformal parts
  return (std::hypot(m(0, 0) + m(1, 1), m(0, 1) - m(1, 0)) + std::hypot(m(0, 0) - m(1, 1), m(0, 1) + m(1, 0))) / 2;
}

Truth empty_truth(const DiscreteRule& rule, double h) {
  return {Tier::exact_discrete,
          fmt::format("powers of the amplification matrix of {} at h = {:.6g} s", rule.name, h),
          {},
          0};
}

Truth of_rotation(const DiscreteRule& rule, const Scene& scene, const StepPlan& steps, double rate) {
  if (!rule.of_system)
    throw Unsupported("the scene is a first-order system x' = f(x, t), and this rule needs positions and velocities");
  Truth truth = empty_truth(rule, steps.h);
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  a(0, 1) = -rate, a(1, 0) = rate;
  const Increment step = rule.of_system(a, steps.h);
  for (int sample = 0; sample <= steps.samples; ++sample) {
    const long n = static_cast<long>(sample) * steps.steps_per_sample;
    truth.trajectory.t.push_back(steps.time(sample, 0));
    truth.trajectory.x.push_back(scene.start.x + repeated(step, n) * scene.start.x);  // z gains nothing
    truth.trajectory.v.push_back(scene.start.v);
    truth.bar = std::max(truth.bar, 4 * eps * static_cast<double>(n) * truth.trajectory.x.back().norm());
  }
  return truth;
}

/// The largest sum(k) / m of a free particle, 1/s^2.
double stiffest(const Model& model) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(model.particles.size());
  if (const auto* springs = model.find<Springs>())
    for (const Spring& s : springs->list) sum[s.a] += s.k, sum[s.b] += s.k;
  for (int pin : model.particles.pins) sum[pin] = 0;
  return (sum.array() / model.particles.mass.array()).maxCoeff();
}

}  // namespace

Truth discrete_truth(const DiscreteRule& rule, const Scene& scene, const Run& run) {
  const Model& model = scene.model;
  const StepPlan steps = plan(run);
  if (const auto* rotation = model.find<Rotation>()) return of_rotation(rule, scene, steps, rotation->rate);
  const auto linear = linear_scene(scene);
  if (!linear) throw Unsupported("the scene is not linear: a rule has a closed form where it multiplies by a matrix");
  if (model.particles.move) throw Unsupported("the pins are moved: closed forms of rules are for pins at rest");
  const auto* springs = model.find<Springs>();
  const auto* dashpots = model.find<Dashpots>();
  if (rule.one_spring && ((springs && springs->list.size() > 1) || (dashpots && dashpots->list.size() > 1)))
    throw Unsupported("this rule sweeps the springs one by one: it has a closed form for a single spring only");

  Truth truth = empty_truth(rule, steps.h);
  std::vector<Increment> of_step;
  std::vector<double> omega;  // 1/s, by which errors in velocity become errors in position
  for (const Mode& m : linear->modes) {
    of_step.push_back(rule.of_mode(m, steps.h));
    omega.push_back(std::max(std::sqrt(m.w2), 1 / run.duration));
  }
  double growth = 1, farthest = 0, fastest = 0;
  std::vector<double> centre(of_step.size(), 0), amplitude(of_step.size(), 0);
  for (int sample = 0; sample <= steps.samples; ++sample) {
    State s = scene.start;
    const long n = static_cast<long>(sample) * steps.steps_per_sample;
    for (size_t i = 0; i < of_step.size(); ++i) {
      const Mode& m = linear->modes[i];
      const Increment power = repeated(of_step[i], n);
      const Eigen::Vector3d gained = power * Eigen::Vector3d(m.u0, m.v0, 1);
      s.x += gained[0] * m.shape;
      s.v += gained[1] * m.shape;
      growth = std::max(growth, growth_of(power, omega[i]));
      if (m.w2 == 0) continue;
      centre[i] = m.push / m.w2;
      amplitude[i] = std::hypot(m.u0 + gained[0] - centre[i], (m.v0 + gained[1]) / omega[i]);
    }
    const double t = steps.time(sample, 0);
    if (!(linear->room(model, centre, amplitude) > 0))
      throw Unsupported(fmt::format("at {:.4g} s a spring may turn over, where its law is not linear", t));
    farthest = std::max(farthest, largest_column(s.x));
    fastest = std::max(fastest, largest_column(s.v));
    truth.trajectory.t.push_back(t);
    truth.trajectory.x.push_back(std::move(s.x));
    truth.trajectory.v.push_back(std::move(s.v));
  }
  const double in_velocity = fastest + steps.h * stiffest(model) * farthest;
  truth.bar = 4 * eps * steps.samples * static_cast<double>(steps.steps_per_sample) * growth *
              (farthest + in_velocity / *std::min_element(omega.begin(), omega.end()));
  return truth;
}

}  // namespace crosscheck
