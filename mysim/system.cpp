// Sums the terms of a model into accelerations.
#include "mysim/system.h"

namespace crosscheck {

System::System(const Model& model) : model_(model) {
  const int n = model.particles.size();
  forces_.f = Points::Zero(3, n);
  drag_rate_ = Eigen::ArrayXd::Zero(n);
  if (const auto* drag = model.find<Drag>()) drag_rate_ = drag->c.array() / model.particles.mass.array();
  if (const auto* springs = model.find<Springs>()) spring_kernel_.emplace(*springs, n);
  for (const Term& term : model.terms)
    has_velocity_forces_ |= std::visit([]<class T>(const T&) { return UsesVelocity<T>; }, term);
}

/// a = sum of the wanted forces over the mass; `wanted` is asked with the type of each term.
template <class Wanted>
void System::sum_forces(const State& stage, Wanted wanted, Points& a) {
  const Particles& particles = model_.particles;
  forces_.clear();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (std::is_same_v<T, Springs>) {
            if (wanted(t)) spring_kernel_->add_force(stage.x, forces_);
          } else if constexpr (HasForce<T>) {
            if (wanted(t)) add_force(t, particles, stage, forces_);
          }
        },
        term);
  for (int i = 0; i < particles.size(); ++i) a.col(i) = forces_.f.col(i) / particles.mass[i];
  for (int pin : particles.pins) a.col(pin).setZero();
  coincident_ += forces_.coincident;
  ++evaluations_;
}

void System::acceleration(State& stage, Points& a) {
  model_.particles.place_pins(stage);
  sum_forces(
      stage, [](const auto&) { return true; }, a);
}

void System::position_acceleration(State& stage, Points& a) {
  model_.particles.place_pins(stage);
  sum_forces(
      stage, []<class T>(const T&) { return !std::is_same_v<T, Drag> && !UsesVelocity<T>; }, a);
}

void System::add_velocity_acceleration(const State& stage, Points& a) {
  const Particles& particles = model_.particles;
  forces_.clear();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (UsesVelocity<T>) add_force(t, particles, stage, forces_);
        },
        term);
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) a.col(i) += forces_.f.col(i) / particles.mass[i];
  ++evaluations_;
}

void System::external_acceleration(State& stage, Points& a) {
  sum_forces(
      stage,
      []<class T>(const T&) {
        return !std::is_same_v<T, Springs> && !std::is_same_v<T, Dashpots> && !std::is_same_v<T, Drag>;
      },
      a);
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
