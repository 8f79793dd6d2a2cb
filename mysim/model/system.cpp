#include "mysim/model/system.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "mysim/base/random.h"

namespace crosscheck {

void add_stiffness(const Model& model, const State& state, Curvature curvature, Tangent& tangent) {
  for (const Term& term : model.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasTangent<T> && !UsesVelocity<T>) add_tangent(t, model.particles, state, curvature, tangent);
        },
        term);
}

namespace {

template <class T>
constexpr bool by_position = HasForce<T> && !std::is_same_v<T, Drag> && !UsesVelocity<T>;

}  // namespace

System::System(const Model& model) : model_(model) {
  const int n = model.particles.size();
  forces_.f = Points::Zero(3, n);
  drag_rate_ = Eigen::ArrayXd::Zero(n);
  if (const auto* drag = model.find<Drag>()) drag_rate_ = drag->c.array() / model.particles.mass.array();
  if (const auto* springs = model.find<Springs>()) spring_kernel_.emplace(*springs, n);
  for (const Term& term : model.terms)
    has_velocity_forces_ |= std::visit([]<class T>(const T&) { return UsesVelocity<T>; }, term);
}

template <class Wanted>
void System::sum_forces(const State& stage, Wanted wanted) {
  assert(stage.x.cols() == model_.particles.size());
  forces_.clear();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasForce<T>) {
            if (!wanted(t)) return;
            if constexpr (std::is_same_v<T, Springs>)
              spring_kernel_->add_force(stage.x, forces_);
            else
              add_force(t, model_.particles, stage, forces_);
          }
        },
        term);
  degenerate_springs_ += forces_.degenerate_springs;
  ++evaluations_;
}

void System::set_acceleration(Points& a) const {
  const Particles& particles = model_.particles;
  assert(a.cols() == particles.size());
  for (int i = 0; i < particles.size(); ++i) a.col(i) = forces_.f.col(i) / particles.mass[i];
  for (int pin : particles.pins) a.col(pin).setZero();
}

void System::acceleration(State& stage, Points& a) {
  model_.particles.place_pins(stage);
  sum_forces(stage, [](const auto&) { return true; });
  set_acceleration(a);
}

void System::position_acceleration(State& stage, Points& a) {
  model_.particles.place_pins(stage);
  sum_forces(stage, []<class T>(const T&) { return by_position<T>; });
  set_acceleration(a);
}

void System::add_velocity_acceleration(const State& stage, Points& a) {
  sum_forces(stage, []<class T>(const T&) { return UsesVelocity<T>; });
  for (int i = 0; i < model_.particles.size(); ++i)
    if (!model_.particles.pinned[i]) a.col(i) += forces_.f.col(i) / model_.particles.mass[i];
}

void System::external_acceleration(const State& stage, Points& a) {
  sum_forces(stage, []<class T>(const T&) {
    return !std::is_same_v<T, Springs> && !std::is_same_v<T, Bending> && !std::is_same_v<T, Dashpots> &&
           !std::is_same_v<T, Drag>;
  });
  set_acceleration(a);
}

void System::derivative(State& stage, State& rate) {
  if (!model_.first_order()) {
    acceleration(stage, rate.v);
    rate.x = stage.v;
    return;
  }
  rate.x.setZero();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasVelocityField<T>) add_velocity(t, stage, rate.x);
        },
        term);
  ++evaluations_;
}

double highest_frequency(const Model& model, const State& state) {
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

double highest_frequency_bound(const Model& model, const State& state) {
  Model far = model;
  if (auto* springs = far.find<Springs>())
    for (Spring& s : springs->list) s.rest *= 1e-6;
  return highest_frequency(far, state);
}

std::optional<double> uniform_drag_rate(const Model& model) {
  const auto* drag = model.find<Drag>();
  if (!drag) return 0;
  std::optional<double> rate;
  for (int i = 0; i < model.particles.size(); ++i) {
    if (model.particles.pinned[i]) continue;
    const double gamma = drag->c[i] / model.particles.mass[i];
    // gammas recovered from c = m gamma agree up to a few roundings
    if (rate && std::abs(gamma - *rate) > 4 * std::numeric_limits<double>::epsilon() * *rate) return std::nullopt;
    if (!rate) rate = gamma;
  }
  return rate;
}

}  // namespace crosscheck
