// The verdict on a run, from its positions.
#include "mysim/observers/watch.h"

#include <algorithm>
#include <cmath>

#include "mysim/system.h"

namespace crosscheck {

Watch::Watch(const Scene& scene, const Run& run, ReachFunction reach) : Watch(scene.model, &scene.start) {
  true_ = [&scene, &run, reach = std::move(reach)] { return reach(scene, run); };
}

Watch::Watch(const Model& model, const State* start) : model_(model) {
  if (start) start_ = *start;
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& s : spheres->list)
      if (s.motion) {
        // a particle leaves at (1 + e) times the sphere's speed at most; as much energy again may go into springs
        const double speed = (1 + s.restitution) * top_speed(*s.motion);
        moving_spheres_ += model.particles.mass.sum() * speed * speed;
      }
  // an engine that pushes a resting particle out of a contact hands it a little speed: that of a fall by a millimetre
  if (const auto* gravity = model.find<Gravity>(); gravity && model.find<Spheres>()) {
    contact_ = 1e-3 * model.particles.mass.sum() * gravity->acceleration.norm();
    slowest_ = std::sqrt(2e-3 * gravity->acceleration.norm());
  }
  if (model.find<Wind>() || model.find<Aerodynamics>() || model.particles.move)
    ledger_.emplace(model, ContactLoss::reported);
}

void Watch::begin(const State& state) {
  begun_ = true;
  if (!start_) start_ = state;
  if (start_->v.cols() != start_->x.cols()) start_->v = Points::Zero(3, start_->x.cols());
  State& start = *start_;
  const Particles& particles = model_.particles;
  const Energy energy = energy_of(model_, start);
  given_ = energy.kinetic + energy.elastic + moving_spheres_ + contact_;
  weight_0_ = energy.gravitational;
  System system(model_);
  Points a(3, start.x.cols());
  system.acceleration(start, a);
  // engines in single precision know a position to 6e-8 of its coordinates, and five such roundings in two steps are
  // no motion
  const double known = rounded_ = 5 * 6e-8 * start.x.cwiseAbs().maxCoeff();
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) {
      pull_ += particles.mass[i] * a.col(i).squaredNorm();
      rounding_ += particles.mass[i] / 2 * 3 * known * known;
    }
  at_start_ = std::max(1., largest_stretch(model_, start, start.x));
  if (ledger_) ledger_->observe(start, false);
}

bool Watch::frozen(const State& state) {
  const State start = std::move(*first_);
  first_.reset();
  asked_ = true;
  if (model_.find<Constraints>()) return false;
  for (int i = 0; i < start.x.cols(); ++i)
    if (!model_.particles.pinned[i] && (state.x.col(i) != start.x.col(i) || state.v.col(i) != start.v.col(i)))
      return false;
  System system(model_);
  State stage = start;
  Points a(3, stage.x.cols());
  system.acceleration(stage, a);
  const auto* spheres = model_.find<Spheres>();
  // what moves must be seen in the last bit: a way of 1e-12 of the coordinates, well above their rounding
  const double seen = 1e-12 * (1 + start.x.cwiseAbs().maxCoeff()), t = state.t - start.t;
  for (int i = 0; i < start.x.cols(); ++i)
    if (!model_.particles.pinned[i] && (start.v.col(i) * t + a.col(i) * (t * t / 2)).norm() > seen &&
        !(spheres && clearance_from(*spheres, start.t, start.x.col(i)) < 1e-6))
      return true;
  return false;
}

Verdict Watch::moves_too_fast(const State& state) {
  const Particles& particles = model_.particles;
  const double span = state.t - before_.t, h = span / 2;
  double kinetic = 0, furthest = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) {
      const double square = (state.x.col(i) - before_.x.col(i)).squaredNorm();
      kinetic += particles.mass[i] / 2 * square, furthest = std::max(furthest, square);
    }
  kinetic /= span * span;
  fastest_ = std::max(fastest_, (std::sqrt(furthest) - rounded_) / span);
  if (const auto* gravity = model_.find<Gravity>())
    sunk_ = std::max(sunk_, std::abs(potential_energy(*gravity, particles, state) - weight_0_));
  if (ledger_) {
    State middle{last_.t, last_.x, (state.x - before_.x) / span};
    particles.place_pins(middle);
    ledger_->observe(middle, false);
    const LedgerRow row = ledger_->now(middle);
    worked_ = std::max(worked_, std::abs(row.wind + row.pins));
  }
  const double had = given_ + sunk_ + worked_ + 2 * h * h * pull_ + rounding_ / (span * span);
  if (!std::isfinite(kinetic) || !std::isfinite(had)) return Verdict::nan;
  if (had > 0) most_ = std::max(most_, kinetic / had);
  if (kinetic > (true_ ? blown_up : suspect) * had) return Verdict::energy;
  return reach_ && beyond_reach() == Verdict::energy ? Verdict::energy : Verdict::ok;
}

Verdict Watch::beyond_reach() const {
  if (fastest_ > allowed * std::max(reach_->speed, slowest_)) return Verdict::energy;
  return longest_ > allowed * std::max(reach_->stretch, 1.) ? Verdict::stretch : Verdict::ok;
}

Verdict Watch::goes_too_far(const State& state) {
  longest_ = std::max(longest_, largest_stretch(model_, *start_, state.x));
  if (true_ && !reach_ && (most_ > in_order || longest_ > longer * at_start_)) {
    reach_ = true_();
    if (!reach_) true_ = nullptr;
  }
  if (reach_) return beyond_reach();
  if (true_) return Verdict::ok;
  // nobody to ask
  if (most_ > suspect) return Verdict::energy;
  return longest_ > allowed * longer * at_start_ ? Verdict::stretch : Verdict::ok;
}

void Watch::earlier(const State& state) {
  if (every_step()) return;
  before_.t = state.t, before_.x = state.x;
  paired_ = true;
}

Verdict Watch::observe(const State& state, bool sample) {
  if (!state.x.allFinite() || !state.v.allFinite()) return Verdict::nan;
  if (model_.first_order()) return Verdict::ok;  // no energy to judge by
  if (!begun_) begin(state);
  const Verdict moves = paired_ || seen_ >= 2 ? moves_too_fast(state) : Verdict::ok;
  if (!paired_) {
    std::swap(before_, last_);
    last_.t = state.t, last_.x = state.x;
    ++seen_;
  }
  paired_ = false;
  if (!closely_ && !every_step() && most_ > in_order) closely_ = true, seen_ = 0;
  if (!sample || moves != Verdict::ok) return moves;
  if (state.v.cols() == state.x.cols()) {
    if (!first_ && !asked_)
      first_ = state;
    else if (first_ && frozen(state))
      return Verdict::frozen;
  }
  return goes_too_far(state);
}

Verdict Watch::later(const State& state) { return every_step() ? Verdict::ok : observe(state, false); }

Verdict Watched::observe(const State& state, bool sample) {
  const Verdict others = others_.observe(state, sample);
  const Verdict own = sample || watch_.every_step() ? watch_.observe(state, sample) : Verdict::ok;
  return others == Verdict::ok ? own : others;
}

void Watched::earlier(const State& state) { watch_.earlier(state); }

Verdict Watched::later(const State& state) { return watch_.later(state); }

}  // namespace crosscheck
