// The verdict on a run, from its energy.
#include "mysim/observers/watch.h"

#include <algorithm>
#include <cmath>

#include "mysim/system.h"

namespace crosscheck {

Watch::Watch(const Model& model) : model_(model) {
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& s : spheres->list)
      if (s.motion) {
        // a particle leaves at (1 + e) times the sphere's speed at most; as much energy again may go into springs
        const double speed = (1 + s.restitution) * top_speed(*s.motion);
        moving_spheres_ += model.particles.mass.sum() * speed * speed;
      }
  if (const auto* gravity = model.find<Gravity>(); gravity && model.find<Spheres>())
    contact_ = 1e-3 * model.particles.mass.sum() * gravity->acceleration.norm();
  if (model.find<Wind>() || model.find<Aerodynamics>() || model.particles.move)
    ledger_.emplace(model, ContactLoss::reported);
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

Verdict Watch::observe(const State& state, bool sample) {
  if (!state.x.allFinite() || !state.v.allFinite()) return Verdict::nan;
  if (model_.first_order() || state.v.cols() == 0) return Verdict::ok;  // no energy to judge by
  if (ledger_) ledger_->observe(state, false);
  if (!sample) return Verdict::ok;

  const Energy energy = energy_of(model_, state);
  if (!start_) {
    start_ = energy;
    // rounding is no motion: 1e-12 of each spring's length, 1e-14 of the energies
    budget_ = (1 + 1e-14) * (energy.kinetic + energy.elastic) + 1e-14 * std::abs(energy.gravitational);
    if (const auto* springs = model_.find<Springs>())
      for (const Spring& s : springs->list)
        budget_ += 1e-24 * s.k * (state.x.col(s.a) - state.x.col(s.b)).squaredNorm();
    budget_ += moving_spheres_ + contact_;
    given_ = budget_;
    stretch_.emplace(model_, state);
  }
  if (!first_ && !asked_)
    first_ = state;
  else if (first_ && frozen(state))
    return Verdict::frozen;
  double work = 0;
  if (ledger_) {
    const LedgerRow row = ledger_->now(state);
    work = row.wind + row.pins;
  }
  if (!std::isfinite(energy.total()) || !std::isfinite(work)) return Verdict::nan;
  worked_ = std::max(worked_, std::abs(work));
  budget_ = std::max({budget_, std::abs(energy.gravitational - start_->gravitational), worked_});
  if (energy.total() - start_->total() - work > budget_) return Verdict::energy;
  // a rule's energy may swing by as much again as start and work gave. Of gravity's part, which the budget above lets
  // it make twice, the bound has what sinking gives and no more
  return stretch_->exceeded(state, 2 * (given_ + worked_)) ? Verdict::stretch : Verdict::ok;
}

}  // namespace crosscheck
