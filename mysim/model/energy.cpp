#include "mysim/model/energy.h"

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
  const Particles& particles = model.particles;
  Energy e;
  for (int i = 0; i < state.v.cols(); ++i)
    if (!particles.pinned[i]) e.kinetic += 0.5 * particles.mass[i] * state.v.col(i).squaredNorm();
  const Overloaded add{
      [&](const OneOf<Springs, Bending> auto& t) { e.elastic += potential_energy(t, particles, state); },
      [&](const Gravity& t) { e.gravitational += potential_energy(t, particles, state); },
      []<OneOf<Rotation, Dashpots, Constraints, Drag, Wind, Aerodynamics, Spheres, Planes> T>(const T&) {
        static_assert(!HasPotential<T>);
      },
  };
  for (const Term& term : model.terms) std::visit(add, term);
  return e;
}

static Springs springs_at_pins(const Springs& springs, const Particles& particles) {
  Springs held{.law = springs.law};
  for (const Spring& s : springs.list)
    if (particles.pinned[s.a] || particles.pinned[s.b]) held.list.push_back(s);
  return held;
}

Power power_of(const Model& model, const State& state, Forces& scratch) {
  const Particles& particles = model.particles;
  Power p;
  auto force_of = [&](const auto& term) -> const Points& {
    scratch.clear();
    add_force(term, particles, state, scratch);
    return scratch.f;
  };
  auto on_pins = [&](const Points& f) {
    double power = 0;
    for (int pin : particles.pins) power += f.col(pin).dot(state.v.col(pin));
    return power;
  };
  const Overloaded add{
      [&](const Drag& t) {
        for (int i = 0; i < particles.size(); ++i)
          if (!particles.pinned[i]) p.drag += t.c[i] * state.v.col(i).squaredNorm();
      },
      [&](const OneOf<Wind, Aerodynamics> auto& t) { p.wind += free_power(particles, force_of(t), state.v); },
      [&](const Springs& t) {
        if (particles.move) p.pins -= on_pins(force_of(springs_at_pins(t, particles)));
      },
      [&](const Bending& t) {
        if (particles.move) p.pins -= on_pins(force_of(t));
      },
      [&](const Dashpots& t) {
        const Points& f = force_of(t);
        const double given = particles.move ? -on_pins(f) : 0;
        // a pair dissipates the power that its free ends lose, plus the power that its moved pins supply
        p.dashpots += given - free_power(particles, f, state.v);
        p.pins += given;
      },
      [](const Gravity&) {},                                             // gravity's work is the change of its energy
      [](const OneOf<Rotation, Constraints, Spheres, Planes> auto&) {},  // no forces
  };
  for (const Term& term : model.terms) std::visit(add, term);
  return p;
}

}  // namespace crosscheck
