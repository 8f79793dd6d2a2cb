#include "reference/truth/independent/right_hand_side.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"

namespace crosscheck {
namespace {

void copy(const Vec3& from, double to[3]) { std::copy_n(from.data(), 3, to); }

}  // namespace

PrescribedMotion::PrescribedMotion(const Motion& motion)
    : omega_(2 * std::numbers::pi * motion.frequency), ramp_(motion.ramp) {
  copy(motion.amplitude, amplitude_);
}

void PrescribedMotion::at(double t, double displacement[3], double velocity[3]) const {
  // s = 10 u^3 - 15 u^4 + 6 u^5 until u = t / ramp = 1
  const double u = std::min(t / ramp_, 1.0);
  const double ramp_value = 10 * std::pow(u, 3) - 15 * std::pow(u, 4) + 6 * std::pow(u, 5);
  const double ramp_rate = 30 * u * u * std::pow(1 - u, 2) / ramp_;
  const double sine = std::sin(omega_ * t), cosine = std::cos(omega_ * t);
  for (int axis = 0; axis < 3; ++axis) {
    displacement[axis] = amplitude_[axis] * ramp_value * sine;
    velocity[axis] = amplitude_[axis] * (ramp_rate * sine + ramp_value * omega_ * cosine);
  }
}

void PrescribedMotion::acceleration_at(double t, double acceleration[3]) const {
  const double u = std::min(t / ramp_, 1.0);
  const double ramp_value = 10 * std::pow(u, 3) - 15 * std::pow(u, 4) + 6 * std::pow(u, 5);
  const double ramp_rate = 30 * u * u * std::pow(1 - u, 2) / ramp_;
  const double ramp_bend = 60 * u * (1 - u) * (1 - 2 * u) / (ramp_ * ramp_);
  const double sine = std::sin(omega_ * t), cosine = std::cos(omega_ * t);
  for (int axis = 0; axis < 3; ++axis)
    acceleration[axis] =
        amplitude_[axis] * ((ramp_bend - ramp_value * omega_ * omega_) * sine + 2 * ramp_rate * omega_ * cosine);
}

double velocity_time_unit(const Scene& scene) {
  if (scene.model.first_order()) return 1;
  const double omega = highest_frequency(scene.model, scene.start);
  return std::exp2(std::ilogb(omega > 0 ? std::sqrt(scene.duration / omega) : scene.duration));
}

Scene without_contact(Scene scene) {
  std::erase_if(scene.model.terms,
                [](const Term& t) { return std::holds_alternative<Spheres>(t) || std::holds_alternative<Planes>(t); });
  return scene;
}

void Solid::move_to(double t) {
  if (motion) {
    double displacement[3];
    motion->at(t, displacement, velocity.data());
    motion->acceleration_at(t, acceleration.data());
    centre = start + Eigen::Map<const Vec3>(displacement);
  } else if (moves()) {
    centre = start + t * drift;
  }
}

std::vector<Solid> solids_of(const Scene& scene) {
  if (scene.model.find<Constraints>()) throw Unsupported("this solver does not support hard distances");
  std::vector<Solid> solids;
  if (const auto* spheres = scene.model.find<Spheres>())
    for (const Sphere& s : spheres->list) {
      const double radius = s.radius + s.margin;
      solids.push_back({s.centre, radius, Vec3::Zero(), s.friction, s.restitution, radius});
      if (s.motion) solids.back().motion.emplace(*s.motion);
    }
  if (const auto* planes = scene.model.find<Planes>())
    for (const Plane& p : planes->list)
      solids.push_back({.start = p.point + p.margin * p.normal,
                        .radius = INFINITY,
                        .up = p.normal,
                        .friction = p.friction,
                        .restitution = p.restitution,
                        .size = scene.size(),
                        .drift = p.velocity.value_or(Vec3::Zero())});
  if (solids.empty()) throw Unsupported("the scene has no contact and therefore no events");
  return solids;
}

RightHandSide::Signal RightHandSide::signal_of(const WindSignal& wind_signal) {
  Signal signal;
  copy(wind_signal.mean, signal.mean);
  if (wind_signal.gusts) {
    copy(wind_signal.gusts->side, signal.side);
    signal.variation = wind_signal.gusts->variation;
    for (const auto& [weight, omega, phase] : wind_signal.gusts->along.waves)
      signal.along.push_back({weight, omega, phase});
    for (const auto& [weight, omega, phase] : wind_signal.gusts->across.waves)
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

RightHandSide::RightHandSide(const Scene& scene, double time_unit)
    : time_unit_(time_unit), n_(scene.model.particles.size()) {
  const Particles& p = scene.model.particles;
  mass_.assign(p.mass.data(), p.mass.data() + n_);
  pinned_.assign(n_, 0);
  for (int pin : p.pins) pinned_[pin] = 1;
  start_position_.assign(scene.start.x.data(), scene.start.x.data() + 3 * n_);
  for (size_t i = 0; i < p.pins.size(); ++i) copy(p.pin_home.col(static_cast<int>(i)), &start_position_[3 * p.pins[i]]);
  for (int i = 0; i < n_; ++i)
    if (!pinned_[i]) free_.push_back(i);
  if (p.move) pin_motion_.emplace(*p.move);
  for (const Term& term : scene.model.terms) add_term(term);
  x_ = start_position_;
  v_.assign(3 * n_, 0);
  f_.assign(3 * n_, 0);
  for (int i : free_) start_.insert(start_.end(), scene.start.x.col(i).begin(), scene.start.x.col(i).end());
  if (!first_order_)
    for (int i : free_)
      for (const double v : scene.start.v.col(i)) start_.push_back(time_unit_ * v);
}

/// A term without an overload does not compile, so no term is omitted silently.
void RightHandSide::add_term(const Term& term) {
  struct TermVisitor {
    RightHandSide& f;
    void operator()(const Rotation& t) const { f.first_order_ = true, f.rotation_rate_ += t.rate; }
    void operator()(const Gravity& t) const {
      for (int axis = 0; axis < 3; ++axis) f.gravity_[axis] += t.acceleration[axis];
    }
    void operator()(const Springs& t) const {
      f.link_law_ = t.law == SpringLaw::bullet_link;
      for (const Spring& s : t.list) f.springs_.push_back({s.a, s.b, s.k, s.rest});
    }
    void operator()(const Bending& t) const {
      // expanded: k/2 |sum w_i x_i|^2 is the energy of springs without rest length between each pair of particles
      for (const auto& s : t.list)
        for (int i = 0; i < s.size; ++i)
          for (int j = i + 1; j < s.size; ++j)
            f.bars_.push_back({s.particle[i], s.particle[j], -s.weight[i] * s.weight[j] * s.k});
    }
    void operator()(const Dashpots& t) const {
      for (const auto& d : t.list) f.dashpots_.push_back({d.a, d.b, d.c});
    }
    void operator()(const Constraints& t) const {
      for (const auto& c : t.list) f.hard_distances_.push_back({c.a, c.b});
    }
    void operator()(const Drag& t) const { f.drag_.assign(t.c.data(), t.c.data() + t.c.size()); }
    void operator()(const Wind& t) const { f.winds_.push_back(signal_of(t.acceleration)); }
    void operator()(const Aerodynamics& t) const {
      f.air_velocities_.push_back(signal_of(t.velocity));
      f.rho_cd_ = t.density * t.coefficient;
      for (const auto& triangle : t.triangles)
        f.triangles_.insert(f.triangles_.end(), triangle.begin(), triangle.end());
    }
    void operator()(const Spheres&) const { refuse_contact(); }
    void operator()(const Planes&) const { refuse_contact(); }
    [[noreturn]] static void refuse_contact() {
      throw Unsupported("the scene has contact, which is no right-hand side: library integrators cannot run it");
    }
  };
  std::visit(TermVisitor{*this}, term);
}

StateVector RightHandSide::start() const { return start_; }

void RightHandSide::set_state(const StateVector& y, double t) {
  if (pin_motion_) {
    double displacement[3], velocity[3];
    pin_motion_->at(t, displacement, velocity);
    for (int i = 0; i < n_; ++i)
      for (int axis = 0; axis < 3 && pinned_[i]; ++axis) {
        x_[3 * i + axis] = start_position_[3 * i + axis] + displacement[axis];
        v_[3 * i + axis] = velocity[axis];
      }
  }
  const size_t half = 3 * free_.size();
  for (size_t m = 0; m < free_.size(); ++m)
    for (int axis = 0; axis < 3; ++axis) {
      x_[3 * free_[m] + axis] = y[3 * m + axis];
      if (!first_order_) v_[3 * free_[m] + axis] = y[half + 3 * m + axis] / time_unit_;
    }
}

void RightHandSide::operator()(const StateVector& y, StateVector& rate, double t) {
  ++evaluations_;
  set_state(y, t);
  if (first_order_) {
    for (size_t m = 0; m < free_.size(); ++m) {
      rate[3 * m] = -rotation_rate_ * y[3 * m + 1];
      rate[3 * m + 1] = rotation_rate_ * y[3 * m];
      rate[3 * m + 2] = 0;
    }
    return;
  }
  std::fill(f_.begin(), f_.end(), 0);
  add_spring_forces();
  add_dashpot_forces();
  for (const auto& [a, b, k] : bars_)
    for (int axis = 0; axis < 3; ++axis) {
      const double pull = k * (x_[3 * b + axis] - x_[3 * a + axis]);
      f_[3 * a + axis] += pull;
      f_[3 * b + axis] -= pull;
    }
  add_aerodynamic_forces(t);
  double all[3] = {gravity_[0], gravity_[1], gravity_[2]};  // m/s^2, on all particles
  for (const Signal& wind : winds_) {
    double part[3];
    wind.at(t, part);
    for (int axis = 0; axis < 3; ++axis) all[axis] += part[axis];
  }
  for (int i = 0; i < n_; ++i)
    for (int axis = 0; axis < 3; ++axis)
      f_[3 * i + axis] += mass_[i] * all[axis] - (drag_.empty() ? 0 : drag_[i] * v_[3 * i + axis]);
  if (!hard_distances_.empty()) add_constraint_forces();
  const size_t half = 3 * free_.size();
  for (size_t m = 0; m < free_.size(); ++m)
    for (int axis = 0; axis < 3; ++axis) {
      rate[3 * m + axis] = y[half + 3 * m + axis] / time_unit_;
      rate[half + 3 * m + axis] = time_unit_ * (f_[3 * free_[m] + axis] / mass_[free_[m]]);
    }
}

void RightHandSide::write_state(const StateVector& y, double t, State& state) {
  set_state(y, t);
  state.t = t;
  state.x = Points::Map(x_.data(), 3, n_);
  if (first_order_)
    state.v.resize(3, 0);
  else
    state.v = Points::Map(v_.data(), 3, n_);
}

void RightHandSide::add_spring_forces() {
  const double* x = x_.data();
  double* f = f_.data();
  for (const auto& [a, b, k, rest] : springs_) {
    const double* from = x + 3 * a;
    const double* to = x + 3 * b;
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (square == 0) {
      degenerate_springs_ += rest > 0;
      continue;
    }
    const double factor =
        link_law_ ? k * (1 - 2 * rest * rest / (square + rest * rest)) : k * (1 - rest / std::sqrt(square));
    for (int axis = 0; axis < 3; ++axis) {
      f[3 * a + axis] += factor * d[axis];
      f[3 * b + axis] -= factor * d[axis];
    }
  }
}

void RightHandSide::add_dashpot_forces() {
  for (const auto& [a, b, c] : dashpots_) {
    double d[3], square = 0, parting = 0;  // parting: half the rate of change of the square
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = x_[3 * b + axis] - x_[3 * a + axis];
      square += d[axis] * d[axis];
      parting += d[axis] * (v_[3 * b + axis] - v_[3 * a + axis]);
    }
    if (square == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      f_[3 * a + axis] += c * parting / square * d[axis];
      f_[3 * b + axis] -= c * parting / square * d[axis];
    }
  }
}

/// Adds the pressure of the air on triangles, a third to each corner.
void RightHandSide::add_aerodynamic_forces(double t) {
  for (const Signal& air : air_velocities_) {
    double wind[3];
    air.at(t, wind);
    for (size_t c = 0; c < triangles_.size(); c += 3) {
      const int corner[3] = {3 * triangles_[c], 3 * triangles_[c + 1], 3 * triangles_[c + 2]};
      double p[3], q[3], relative_wind[3];
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = x_[corner[1] + axis] - x_[corner[0] + axis];
        q[axis] = x_[corner[2] + axis] - x_[corner[0] + axis];
        relative_wind[axis] = wind[axis] - (v_[corner[0] + axis] + v_[corner[1] + axis] + v_[corner[2] + axis]) / 3;
      }
      // twice the area, along the normal
      const double twice_area[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
      const double size = std::hypot(twice_area[0], twice_area[1], twice_area[2]),
                   speed = std::hypot(relative_wind[0], relative_wind[1], relative_wind[2]);
      if (size == 0) continue;
      const double through =
          relative_wind[0] * twice_area[0] + relative_wind[1] * twice_area[1] + relative_wind[2] * twice_area[2];
      // 1/2 rho C |u| (u . n) (area n) / 3, with area n = twice / 2 and n = twice / size
      const double factor = rho_cd_ * speed * through / (12 * size);
      for (int each : corner)
        for (int axis = 0; axis < 3; ++axis) f_[each + axis] += factor * twice_area[axis];
    }
  }
}

/// Adds forces along the rods. They make d . a + |u|^2 = 0 for each rod, where d, u and a are the differences between
/// the positions, velocities and accelerations of the rod's ends.
void RightHandSide::add_constraint_forces() {
  const auto count = static_cast<int>(hard_distances_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd residual(count);
  auto difference = [&](const HardDistance& r) { return Vec3(Vec3::Map(&x_[3 * r.a]) - Vec3::Map(&x_[3 * r.b])); };
  auto inverse_mass = [&](int i) { return pinned_[i] ? 0 : 1 / mass_[i]; };  // 1/kg
  for (int i = 0; i < count; ++i) {
    const HardDistance& r = hard_distances_[i];
    const Vec3 d = difference(r);
    const Vec3 u = Vec3::Map(&v_[3 * r.a]) - Vec3::Map(&v_[3 * r.b]);
    const Vec3 a = inverse_mass(r.a) * Vec3::Map(&f_[3 * r.a]) - inverse_mass(r.b) * Vec3::Map(&f_[3 * r.b]);
    residual[i] = -d.dot(a) - u.squaredNorm();
    for (int j = 0; j <= i; ++j) {
      const HardDistance& s = hard_distances_[j];
      // effect of a unit force along rod s on the difference between the ends of rod r
      const double coupling =
          inverse_mass(r.a) * ((r.a == s.a) - (r.a == s.b)) - inverse_mass(r.b) * ((r.b == s.a) - (r.b == s.b));
      if (coupling != 0) matrix(i, j) = coupling * d.dot(difference(s));
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  // a dependent rod leaves a pivot at round-off, 1e-12 of the largest; the factor contains the square roots of the
  // pivots
  const auto pivots = factor.matrixLLT().diagonal();
  if (factor.info() != Eigen::Success || !(pivots.minCoeff() > 1e-6 * pivots.maxCoeff()))
    throw Unsupported("its hard distances depend on each other: their forces are not unique");
  const Eigen::VectorXd force = factor.solve(residual);
  for (int i = 0; i < count; ++i) {
    const Vec3 along = force[i] * difference(hard_distances_[i]);
    Vec3::Map(&f_[3 * hard_distances_[i].a]) += along;
    Vec3::Map(&f_[3 * hard_distances_[i].b]) -= along;
  }
}

}  // namespace crosscheck
