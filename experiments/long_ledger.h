// The ledger of a run of very many steps: every step counts, few rows are kept.
#pragma once

#include "mysim/observers/ledger.h"

namespace crosscheck {

/// A ledger that chooses its rows by itself: the run's samples, every `stride`-th state, and the first states of each
/// decade, so that short and long times are both seen. No state is kept.
class LongLedger : public Observer {
 public:
  LongLedger(const Model& model, ContactLoss contact, long stride) : ledger_(model, contact), stride_(stride) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override { ledger_.contact(lost); }

  const std::vector<LedgerRow>& rows() const { return ledger_.rows(); }
  bool contact_inferred() const { return ledger_.contact_inferred(); }

 private:
  Ledger ledger_;
  long stride_, seen_ = 0, next_ = 1;
};

/// What the rows of a long run say of its residual r, the balance less the balance at the start (J).
struct LongRun {
  double turned_over = 0;  // J: the largest kinetic energy, or change of gravitational or elastic energy
  double worst = 0;        // J, largest |r|
  double final = 0;        // J, r at the end
  double drift = 0;        // J/s, slope of the straight line through r, least squares
  double oscillation = 0;  // J, RMS deviation of r from that line
  /// log10 of the largest |r| over the run over that of its first tenth: 0 where r is bounded, 1 where it grows in
  /// proportion to time.
  double growth = 0;
  /// 1/s: the drag rate gamma that would take as much from the same motion, -(r(T) - r(0)) / integral of 2 K dt, since
  /// drag takes gamma m v^2 each second. Negative where energy is made.
  double equivalent_drag = 0;
};
LongRun summary_of(const std::vector<LedgerRow>& rows);

}  // namespace crosscheck
