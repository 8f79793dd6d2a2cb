// Value, gradient and second derivatives of the incremental potential.
#include "mysim/implicit/incremental_potential.h"

#include <Eigen/LU>
#include <limits>

namespace crosscheck {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace

IncrementalPotential::IncrementalPotential(System& f) : f_(f), model_(f.model()) {
  const int n = model_.particles.size();
  drag_ = f.drag_rate() * model_.particles.mass.array();
  a_ = moved_ = Points::Zero(3, n);
  frozen_air_.f = Points::Zero(3, n);
  if (const auto* springs = model_.find<Springs>()) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n);
    for (const Spring& s : springs->list) {
      sum[s.a] += s.k;
      sum[s.b] += s.k;
      stiffness_ += s.k;
    }
    stiffest_ = sum.maxCoeff();
  }
}

void IncrementalPotential::clear_pins(Points& p) const {
  for (int pin : model_.particles.pins) p.col(pin).setZero();
}

void IncrementalPotential::begin(const State& start, double h) {
  start_ = end_ = start;
  h_ = h;
  end_.t = start.t + h;
  end_.x += h * start.v;
  model_.particles.place_pins(end_);
  y_ = end_.x;
  inertia_ = model_.particles.mass.array() / (h * h) + drag_ / h;
}

State& IncrementalPotential::end(const Points& u) {
  end_.x = y_ + u;
  end_.v = start_.v + u / h_;
  model_.particles.place_pin_velocities(end_);
  return end_;
}

bool IncrementalPotential::freeze(const Points& u) {
  frozen_air_.clear();
  frozen_damping_.clear();
  bool any = false;
  const State& at = end(u);
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (UsesVelocity<T>) {
            any = true;
            if constexpr (HasTangent<T>)
              add_tangent(t, model_.particles, at, Curvature::exact, frozen_damping_);
            else
              add_force(t, model_.particles, at, frozen_air_);
          }
        },
        term);
  if (any) f_.count(1);
  return any;
}

double IncrementalPotential::value(const Points& u) {
  const Particles& particles = model_.particles;
  const State& at = end(u);
  moved_ = h_ * at.v;
  double inertia = 0, drag = 0;
  for (int i = 0; i < particles.size(); ++i) {
    if (particles.pinned[i]) continue;
    inertia += particles.mass[i] / (2 * h_ * h_) * u.col(i).squaredNorm();
    drag += drag_[i] / (2 * h_) * moved_.col(i).squaredNorm();
  }
  double springs = 0, given = 0;
  for (const Term& term : model_.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (std::is_same_v<T, Springs>)
            springs = potential_energy(t, particles, at);
          else if constexpr (HasPotential<T>)
            given += potential_energy(t, particles, at);
        },
        term);
  if (const auto* wind = model_.find<Wind>()) {
    const Vec3 w = wind->acceleration.at(at.t);
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) given -= particles.mass[i] * w.dot(at.x.col(i));
  }
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) given -= frozen_air_.f.col(i).dot(at.x.col(i));
  a_.setZero();
  frozen_damping_.add_product(0, 1, moved_, a_);
  const double dashpots = dot(moved_, a_) / (2 * h_);
  // a sum of n parts is rounded by at most n eps of their sizes; a spring's energy by k |e| eps |x|, since its ends
  // are, and sum k |e| <= sqrt(sum k e^2) sqrt(sum k)
  rounding_ = particles.size() * eps * (inertia + drag + dashpots + springs + std::abs(given)) +
              8 * eps * std::sqrt(2 * springs * stiffness_) * at.x.cwiseAbs().maxCoeff();
  return inertia + drag + dashpots + springs + given;
}

void IncrementalPotential::gradient(const Points& u, Points& g) {
  const Particles& particles = model_.particles;
  State& at = end(u);
  moved_ = h_ * at.v;
  f_.position_acceleration(at, a_);
  g.setZero(3, particles.size());
  frozen_damping_.add_product(0, 1 / h_, moved_, g);
  force_scale_ = 0;
  for (int i = 0; i < particles.size(); ++i) {
    if (particles.pinned[i]) continue;
    const double m = particles.mass[i];
    const Vec3 inertia = m / (h_ * h_) * u.col(i), drag = drag_[i] / h_ * moved_.col(i);
    force_scale_ = std::max({force_scale_, m / h_ * start_.v.col(i).norm(), inertia.norm(), m * a_.col(i).norm()});
    g.col(i) += inertia + drag - m * a_.col(i) - frozen_air_.f.col(i);
  }
  clear_pins(g);
  // spring forces come from positions, each rounded by eps |x|
  force_rounding_ = 8 * eps * (stiffest_ * at.x.cwiseAbs().maxCoeff() + largest_column(a_) * particles.mass.maxCoeff());
}

void IncrementalPotential::linearise(const Points& u, Curvature curvature) {
  const State& at = end(u);
  tangent_.clear();
  add_stiffness(model_, at, curvature, tangent_);
  const int n = model_.particles.size();
  blocks_.setZero(3, 3 * n);
  tangent_.add_diagonal(1, 0, blocks_);
  frozen_damping_.add_diagonal(0, 1 / h_, blocks_);
  for (int i = 0; i < n; ++i) {
    auto block = blocks_.middleCols<3>(3 * i);
    block.diagonal().array() += inertia_[i];
    block = block.inverse().eval();
  }
}

void IncrementalPotential::apply(const Points& p, Points& out) {
  out = p * inertia_.matrix().asDiagonal();
  tangent_.add_product(1, 0, p, out);
  frozen_damping_.add_product(0, 1 / h_, p, out);
  clear_pins(out);
  f_.count(1);
}

void IncrementalPotential::precondition(const Points& r, Points& out) const {
  out.resize(3, r.cols());
  for (int i = 0; i < r.cols(); ++i) out.col(i) = blocks_.middleCols<3>(3 * i) * r.col(i);
  clear_pins(out);
}

}  // namespace crosscheck
