#include "experiments/stability/margin.h"

#include <fmt/format.h>

#include <cmath>

#include "mysim/model/system.h"
#include "reference/truth/discrete.h"

namespace crosscheck {
namespace {

/// Upper bound of the fastest vibration (S. Gershgorin, 1931), rad/s. omega^2 is at most the maximum over particles a
/// of the sum of |k| / m_a + |k| / sqrt(m_a m_b) over the particle's springs, including those equivalent to bending.
/// Pins have infinite mass.
double bound_of_frequency(const Model& model) {
  const Particles& particles = model.particles;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(particles.size());
  const auto add_spring = [&](int one, int other, double k) {
    for (const auto& [a, b] : {std::pair{one, other}, std::pair{other, one}}) {
      if (particles.pinned[a]) continue;
      sum[a] += std::abs(k) / particles.mass[a];
      if (!particles.pinned[b]) sum[a] += std::abs(k) / std::sqrt(particles.mass[a] * particles.mass[b]);
    }
  };
  for (const Spring& s : model.find<Springs>()->list) add_spring(s.a, s.b, s.k);
  if (const auto* bending = model.find<Bending>()) for_each_pair(*bending, add_spring);
  return sum.size() > 0 ? std::sqrt(sum.maxCoeff()) : 0;
}

}  // namespace

double growth_per_step(const Stepper& rule, const Vibration& vibration, double h) {
  for (const DiscreteStepper& each : discrete_steppers())
    if (each.name == rule.name) {
      const Mode mode{vibration.omega * vibration.omega, vibration.gamma, 0, 0, 0, 0, 0, {}};
      Eigen::Matrix2d m = each.of_mode(mode, h).topLeftCorner<2, 2>() + Eigen::Matrix2d::Identity();
      const double unit = vibration.omega > 0 ? vibration.omega : 1;
      m(0, 1) *= unit, m(1, 0) /= unit;
      // moduli of the roots of lambda^2 - trace lambda + determinant
      const double half = m.trace() / 2, determinant = m.determinant(), square = half * half - determinant;
      return square < 0 ? std::sqrt(determinant) : std::abs(half) + std::sqrt(square);
    }
  return 1;
}

std::string stability_warning(const Method& method, const Scene& scene, double h) {
  constexpr double small = 0.1;
  const Stepper* rule = stepper_of(method);
  const Model& model = scene.model;
  if (!rule || method.adaptive || model.find<Dashpots>() || !model.find<Springs>()) return "";
  const auto gamma = uniform_drag_rate(model);
  if (!gamma || std::isinf(rule->limit(1, *gamma))) return "";
  if (rule->limit(1, *gamma) == 0) {
    const double omega = highest_frequency(model, scene.start);
    const double growth = omega > 0 ? growth_per_step(*rule, {omega, *gamma}, h) - 1 : 0;
    if (!(growth > 0)) return "";
    return fmt::format(
        "no step of {} is stable here: its fastest vibration ({:.3g} rad/s) grows by {:.2g} % in each "
        "step, tenfold in {:.3g} s",
        rule->name, omega, 100 * growth, h * std::log(10) / std::log1p(growth));
  }
  // power iteration is needed only if the bound is not sufficient
  if (rule->limit(bound_of_frequency(model), *gamma) > (1 + small) * h) return "";
  const double omega = highest_frequency_bound(model, scene.start), limit = rule->limit(omega, *gamma);
  if (limit > (1 + small) * h) return "";
  return fmt::format(
      "small margin: the step is {:.0f} % of what is stable once every spring is stretched far "
      "({:.3g} s); a longer run may fail",
      100 * h / limit, limit);
}

}  // namespace crosscheck
