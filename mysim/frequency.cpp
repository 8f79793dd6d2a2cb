// Power iteration on M^-1/2 K M^-1/2.
#include "mysim/frequency.h"

#include <cmath>
#include <limits>
#include <utility>

#include "mysim/system.h"
#include "mysim/uniform.h"

namespace crosscheck {

double fastest_frequency(const Model& model, const State& state) {
  const Particles& particles = model.particles;
  Tangent tangent;
  add_stiffness(model, state, Curvature::clamped, tangent);
  if (tangent.empty()) return 0;

  Eigen::VectorXd root = particles.mass.cwiseSqrt().cwiseInverse();  // 1 / sqrt(m), 0 at pins
  for (int pin : particles.pins) root[pin] = 0;
  std::mt19937_64 engine(1);
  Points v(3, particles.size()), product(3, particles.size());
  for (double& part : v.reshaped()) part = uniform(engine) - 0.5;
  double omega2 = 0;
  for (int i = 0; i < 500; ++i) {
    v = v * root.asDiagonal();
    product.setZero();
    tangent.add_product(1, 0, v, product);
    v = product * root.asDiagonal();
    const double before = std::exchange(omega2, v.norm());
    if (!(omega2 > 0)) return 0;
    v /= omega2;
    if (i > 20 && std::abs(omega2 - before) < 1e-5 * omega2) break;
  }
  return std::sqrt(omega2);
}

double stretched_frequency(const Model& model, const State& state) {
  if (!model.find<Springs>()) return 0;
  Model far = model;
  for (Spring& s : far.find<Springs>()->list) s.rest *= 1e-6;
  return fastest_frequency(far, state);
}

std::optional<double> uniform_drag_rate(const Model& model) {
  const auto* drag = model.find<Drag>();
  if (!drag) return 0;
  std::optional<double> rate;
  for (int i = 0; i < model.particles.size(); ++i) {
    if (model.particles.pinned[i]) continue;
    const double gamma = drag->c[i] / model.particles.mass[i];
    // masses times gamma over masses: equal but for a few roundings
    if (rate && std::abs(gamma - *rate) > 4 * std::numeric_limits<double>::epsilon() * *rate) return std::nullopt;
    if (!rate) rate = gamma;
  }
  return rate;
}

}  // namespace crosscheck
