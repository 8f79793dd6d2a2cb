// Adds up energies at samples and powers at every step.
#include "mysim/observers/ledger.h"

namespace crosscheck {

void Integral::add(double value, double h) {
  last_ = {value, last_[0], last_[1], last_[2]};
  const auto& [p0, p1, p2, p3] = last_;
  switch (count_++) {
    case 0:
      break;
    case 1:
      value_ = h / 2 * (p1 + p0);
      break;
    case 2:
      value_ = h / 3 * (p2 + 4 * p1 + p0);
      break;
    case 3:
      value_ = 3 * h / 8 * (p3 + 3 * p2 + 3 * p1 + p0);
      break;
    default:
      value_ += h / 24 * (9 * p0 + 19 * p1 - 5 * p2 + p3);
  }
}

Ledger::Ledger(const Model& model, ContactLoss contact)
    : model_(model), inferred_(contact != ContactLoss::reported && model.find<Spheres>() != nullptr) {
  estimated_ = contact == ContactLoss::sampled && (model.find<Drag>() || model.find<Dashpots>() || model.find<Wind>() ||
                                                   model.find<Aerodynamics>() || model.particles.move);
  scratch_.f = Points::Zero(3, model.particles.size());
}

LedgerRow Ledger::now(const State& state) const {
  return {state.t, energy_of(model_, state), drag_.value(), dashpots_.value(), contact_, wind_.value(), pins_.value()};
}

Verdict Ledger::observe(const State& state, bool sample) {
  if (state.v.cols() != state.x.cols()) return Verdict::ok;
  const Power power = power_of(model_, state, scratch_);
  const double h = state.t - last_t_;
  drag_.add(power.drag, h);
  dashpots_.add(power.dashpots, h);
  wind_.add(power.wind, h);
  pins_.add(power.pins, h);
  last_t_ = state.t;
  if (sample) {
    rows_.push_back(now(state));
    if (inferred_) rows_.back().contact = rows_.front().balance() - rows_.back().balance();
  }
  return Verdict::ok;
}

}  // namespace crosscheck
