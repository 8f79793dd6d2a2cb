// Sums the terms of a model into accelerations.
#include "mysim/system.h"

namespace crosscheck {

System::System(const Model& model) : model_(model) {
  const int n = model.particles.size();
  forces_.f = Points::Zero(3, n);
  drag_rate_ = Eigen::ArrayXd::Zero(n);
  if (const auto* drag = model.find<Drag>()) drag_rate_ = drag->c.array() / model.particles.mass.array();
}

void System::accelerate(State& stage, Points& a, bool with_drag) {
  const Particles& particles = model_.particles;
  particles.place_pins(stage);
  forces_.clear();
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasForce<T>)
            if (with_drag || !std::is_same_v<T, Drag>) add_force(t, particles, stage, forces_);
        },
        term);
  for (int i = 0; i < particles.size(); ++i) a.col(i) = forces_.f.col(i) / particles.mass[i];
  for (int pin : particles.pins) a.col(pin).setZero();
  coincident_ += forces_.coincident;
  ++evaluations_;
}

void System::acceleration(State& stage, Points& a) { accelerate(stage, a, true); }

void System::undragged_acceleration(State& stage, Points& a) { accelerate(stage, a, false); }

void System::derivative(State& stage, State& rate) {
  if (!model_.first_order()) {
    accelerate(stage, rate.v, true);
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
