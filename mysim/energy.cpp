// Energies and powers of a state.
#include "mysim/energy.h"

namespace crosscheck {
namespace {

/// Sum of f_i . v_i over the free particles, W.
double free_power(const Particles& particles, const Points& f, const Points& v) {
  double power = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) power += f.col(i).dot(v.col(i));
  return power;
}

}  // namespace

Energy energy_of(const Model& model, const State& state) {
  Energy e;
  for (int i = 0; i < state.v.cols(); ++i)
    if (!model.particles.pinned[i]) e.kinetic += 0.5 * model.particles.mass[i] * state.v.col(i).squaredNorm();
  if (const auto* springs = model.find<Springs>()) e.elastic = potential_energy(*springs, model.particles, state);
  if (const auto* gravity = model.find<Gravity>()) e.gravitational = potential_energy(*gravity, model.particles, state);
  return e;
}

Power power_of(const Model& model, const State& state, Forces& scratch) {
  const Particles& particles = model.particles;
  Power p;
  auto force_of = [&](const auto& term) -> const Points& {
    scratch.clear();
    add_force(term, particles, state, scratch);
    return scratch.f;
  };
  if (const auto* drag = model.find<Drag>()) p.drag = -free_power(particles, force_of(*drag), state.v);
  if (const auto* wind = model.find<Wind>()) p.wind = free_power(particles, force_of(*wind), state.v);
  if (const auto* air = model.find<Aerodynamics>()) p.wind += free_power(particles, force_of(*air), state.v);
  auto on_pins = [&](const Points& f) {
    double power = 0;
    for (int pin : particles.pins) power += f.col(pin).dot(state.v.col(pin));
    return power;
  };
  if (const auto* springs = model.find<Springs>(); springs && particles.move) p.pins -= on_pins(force_of(*springs));
  if (const auto* dashpots = model.find<Dashpots>()) {
    const Points& f = force_of(*dashpots);
    const double given = particles.move ? -on_pins(f) : 0;
    // pairs lose what free ends lose and what moved pins put in
    p.dashpots = given - free_power(particles, f, state.v);
    p.pins += given;
  }
  return p;
}

}  // namespace crosscheck
