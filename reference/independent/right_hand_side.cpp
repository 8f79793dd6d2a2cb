// What is taken from a scene, where everything is at a time, and the sum of all forces.
#include "reference/independent/right_hand_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mysim/errors.h"

namespace crosscheck {
namespace {

void copy(const Vec3& from, double to[3]) { std::copy_n(from.data(), 3, to); }

}  // namespace

RightHandSide::Signal RightHandSide::signal_of(const Blowing& blowing) {
  Signal signal;
  copy(blowing.mean, signal.mean);
  if (blowing.gusts) {
    copy(blowing.gusts->side, signal.side);
    signal.variation = blowing.gusts->variation;
    for (const auto& [weight, omega, phase] : blowing.gusts->along.waves)
      signal.along.push_back({weight, omega, phase});
    for (const auto& [weight, omega, phase] : blowing.gusts->across.waves)
      signal.across.push_back({weight, omega, phase});
  }
  return signal;
}

void RightHandSide::Signal::at(double t, double out[3]) const {
  double first = 0, second = 0;
  for (const Sine& s : along) first += s.weight * std::sin(s.phase + s.omega * t);
  for (const Sine& s : across) second += s.weight * std::sin(s.phase + s.omega * t);
  for (int axis = 0; axis < 3; ++axis) out[axis] = mean[axis] + variation * first * mean[axis] + second * side[axis];
}

RightHandSide::RightHandSide(const Scene& scene) : n_(scene.model.particles.size()) {
  const Particles& p = scene.model.particles;
  mass_.assign(p.mass.data(), p.mass.data() + n_);
  fixed_.assign(n_, 0);
  for (int pin : p.pins) fixed_[pin] = 1;
  home_.assign(scene.start.x.data(), scene.start.x.data() + 3 * n_);
  for (size_t i = 0; i < p.pins.size(); ++i) copy(p.pin_home.col(static_cast<int>(i)), &home_[3 * p.pins[i]]);
  for (int i = 0; i < n_; ++i)
    if (!fixed_[i]) moving_.push_back(i);
  if (p.move) {
    carried_ = true;
    copy(p.move->amplitude, sway_);
    sway_omega_ = 2 * std::numbers::pi * p.move->frequency;
    sway_ramp_ = p.move->ramp;
  }
  for (const Term& term : scene.model.terms) take(term);
  x_ = home_;
  v_.assign(3 * n_, 0);
  f_.assign(3 * n_, 0);
  for (int i : moving_) start_.insert(start_.end(), scene.start.x.col(i).begin(), scene.start.x.col(i).end());
  if (!first_order_)
    for (int i : moving_) start_.insert(start_.end(), scene.start.v.col(i).begin(), scene.start.v.col(i).end());
}

/// A term without a line here does not compile: nothing of a scene is left out silently.
void RightHandSide::take(const Term& term) {
  struct Taker {
    RightHandSide& f;
    void operator()(const Rotation& t) const { f.first_order_ = true, f.turning_ += t.rate; }
    void operator()(const Gravity& t) const {
      for (int axis = 0; axis < 3; ++axis) f.falling_[axis] += t.acceleration[axis];
    }
    void operator()(const Springs& t) const {
      f.link_law_ = t.law == SpringLaw::bullet_link;
      for (const Spring& s : t.list) f.pairs_.push_back({s.a, s.b, s.k, s.rest, 0});
    }
    void operator()(const Dashpots& t) const {
      for (const auto& d : t.list) f.pairs_.push_back({d.a, d.b, 0, 0, d.c});
    }
    void operator()(const Constraints& t) const {
      for (const auto& c : t.list) f.rods_.push_back({c.a, c.b});
    }
    void operator()(const Drag& t) const { f.drag_.assign(t.c.data(), t.c.data() + t.c.size()); }
    void operator()(const Wind& t) const { f.winds_.push_back(signal_of(t.acceleration)); }
    void operator()(const Aerodynamics& t) const {
      f.airs_.push_back(signal_of(t.velocity));
      f.air_ = t.density * t.coefficient;
      for (const auto& triangle : t.triangles) f.corners_.insert(f.corners_.end(), triangle.begin(), triangle.end());
    }
    void operator()(const Spheres&) const {
      throw Unsupported("the scene has contact, which is no right-hand side: integrators of others cannot follow it");
    }
  };
  std::visit(Taker{*this}, term);
}

Flat RightHandSide::start() const { return start_; }

/// Positions and velocities of all particles at time t.
void RightHandSide::place(const Flat& y, double t) {
  if (carried_) {
    // s = 10 u^3 - 15 u^4 + 6 u^5 until u = t / ramp = 1
    const double u = std::min(t / sway_ramp_, 1.0);
    const double grown = 10 * std::pow(u, 3) - 15 * std::pow(u, 4) + 6 * std::pow(u, 5);
    const double growing = 30 * u * u * std::pow(1 - u, 2) / sway_ramp_;
    const double sine = std::sin(sway_omega_ * t), cosine = std::cos(sway_omega_ * t);
    for (int i = 0; i < n_; ++i)
      for (int axis = 0; axis < 3 && fixed_[i]; ++axis) {
        x_[3 * i + axis] = home_[3 * i + axis] + sway_[axis] * grown * sine;
        v_[3 * i + axis] = sway_[axis] * (growing * sine + grown * sway_omega_ * cosine);
      }
  }
  const size_t half = 3 * moving_.size();
  for (size_t m = 0; m < moving_.size(); ++m)
    for (int axis = 0; axis < 3; ++axis) {
      x_[3 * moving_[m] + axis] = y[3 * m + axis];
      if (!first_order_) v_[3 * moving_[m] + axis] = y[half + 3 * m + axis];
    }
}

void RightHandSide::operator()(const Flat& y, Flat& rate, double t) {
  ++evaluations_;
  place(y, t);
  if (first_order_) {
    for (size_t m = 0; m < moving_.size(); ++m) {
      rate[3 * m] = -turning_ * y[3 * m + 1];
      rate[3 * m + 1] = turning_ * y[3 * m];
      rate[3 * m + 2] = 0;
    }
    return;
  }
  std::fill(f_.begin(), f_.end(), 0);
  for (const Pair& pair : pairs_) pull(pair);
  blow(t);
  double all[3] = {falling_[0], falling_[1], falling_[2]};  // m/s^2, the same for every particle
  for (const Signal& wind : winds_) {
    double part[3];
    wind.at(t, part);
    for (int axis = 0; axis < 3; ++axis) all[axis] += part[axis];
  }
  for (int i = 0; i < n_; ++i)
    for (int axis = 0; axis < 3; ++axis)
      f_[3 * i + axis] += mass_[i] * all[axis] - (drag_.empty() ? 0 : drag_[i] * v_[3 * i + axis]);
  if (!rods_.empty()) keep_lengths();
  const size_t half = 3 * moving_.size();
  for (size_t m = 0; m < moving_.size(); ++m)
    for (int axis = 0; axis < 3; ++axis) {
      rate[3 * m + axis] = y[half + 3 * m + axis];
      rate[half + 3 * m + axis] = f_[3 * moving_[m] + axis] / mass_[moving_[m]];
    }
}

void RightHandSide::write(const Flat& y, double t, State& state) {
  place(y, t);
  state.t = t;
  state.x = Points::Map(x_.data(), 3, n_);
  if (first_order_)
    state.v.resize(3, 0);
  else
    state.v = Points::Map(v_.data(), 3, n_);
}

}  // namespace crosscheck
