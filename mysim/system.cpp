// Sums the terms of a model into accelerations.
#include "mysim/system.h"

namespace crosscheck {

void add_stiffness(const Model& model, const State& state, Curvature curvature, Tangent& tangent) {
  for (const Term& term : model.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasTangent<T> && !UsesVelocity<T>) add_tangent(t, model.particles, state, curvature, tangent);
        },
        term);
}

System::System(const Model& model) : model_(model) {
  const int n = model.particles.size();
  forces_.f = Points::Zero(3, n);
  drag_rate_ = Eigen::ArrayXd::Zero(n);
  if (const auto* drag = model.find<Drag>()) drag_rate_ = drag->c.array() / model.particles.mass.array();
  if (const auto* springs = model.find<Springs>()) spring_kernel_.emplace(*springs, n);
  for (const Term& term : model.terms)
    has_velocity_forces_ |= std::visit([]<class T>(const T&) { return UsesVelocity<T>; }, term);
}

/// forces_ = sum of the wanted forces; `wanted` is asked with each term.
template <class Wanted>
void System::sum_forces(const State& stage, Wanted wanted) {
  forces_.clear();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (std::is_same_v<T, Springs>) {
            if (wanted(t)) spring_kernel_->add_force(stage.x, forces_);
          } else if constexpr (HasForce<T>) {
            if (wanted(t)) add_force(t, model_.particles, stage, forces_);
          }
        },
        term);
  coincident_ += forces_.coincident;
  ++evaluations_;
}

/// a = forces_ / m, zero at pins.
void System::set_acceleration(Points& a) const {
  const Particles& particles = model_.particles;
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
  sum_forces(stage, []<class T>(const T&) { return !std::is_same_v<T, Drag> && !UsesVelocity<T>; });
  set_acceleration(a);
}

void System::add_velocity_acceleration(const State& stage, Points& a) {
  sum_forces(stage, []<class T>(const T&) { return UsesVelocity<T>; });
  for (int i = 0; i < model_.particles.size(); ++i)
    if (!model_.particles.pinned[i]) a.col(i) += forces_.f.col(i) / model_.particles.mass[i];
}

void System::external_acceleration(const State& stage, Points& a) {
  sum_forces(stage, []<class T>(const T&) {
    return !std::is_same_v<T, Springs> && !std::is_same_v<T, Dashpots> && !std::is_same_v<T, Drag>;
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

}  // namespace crosscheck
