// The energy ledger: what a run has, what it lost, what it was given, and what does not add up.
#pragma once

#include <array>
#include <vector>

#include "mysim/energy.h"
#include "mysim/run.h"

namespace crosscheck {

/// Integral of a quantity sampled at equal steps, to fourth order: Simpson's 3/8 rule over the first three steps, then
/// the Adams-Moulton weights (9, 19, -5, 1) h / 24.
class Integral {
 public:
  void add(double value, double h);
  double value() const { return value_; }

 private:
  std::array<double, 4> last_{};  // newest first
  int count_ = 0;
  double value_ = 0;
};

enum class ContactLoss {
  reported,  // the engine tells what its contacts take
  inferred,  // it does not: what is missing from the balance is called contact loss, and no closure is claimed
  sampled,   // nor is more seen than samples: what drag and air took between them is an estimate, no closure either
};

struct LedgerRow {
  double t;               // s
  Energy energy;          // J
  double drag, dashpots;  // J, taken by them since the start
  double contact;         // J, lost in contact since the start: friction and impacts, less what moving spheres gave
  double wind, pins;      // J, work done by the wind and by moved pins since the start
  double dissipated() const { return drag + dashpots; }
  /// total + dissipated + contact - wind - pins, J: constant up to the method's error.
  double balance() const { return energy.total() + dissipated() + contact - wind - pins; }
};

/// States without velocities leave no row: they have no energy.
class Ledger : public Observer {
 public:
  Ledger(const Model& model, ContactLoss contact);
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override { contact_ += lost; }

  const std::vector<LedgerRow>& rows() const { return rows_; }
  /// True where no closure of the balance is claimed.
  bool contact_inferred() const { return inferred_ || estimated_; }
  LedgerRow now(const State& state) const;

 private:
  const Model& model_;
  bool inferred_;   // a sphere is there and the engine does not report its losses
  bool estimated_;  // integrals from samples alone
  Forces scratch_;
  Integral drag_, dashpots_, wind_, pins_;
  double contact_ = 0, last_t_ = 0;
  std::vector<LedgerRow> rows_;
};

}  // namespace crosscheck
