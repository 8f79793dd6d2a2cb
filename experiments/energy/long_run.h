// Statistics of long runs: drift, oscillation and growth of the energy residual, and numerical damping.
#pragma once

#include <optional>
#include <string>

#include "experiments/experiment.h"
#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

// The ledger of a run of very many steps: every step counts, few rows are kept.

/// A ledger that chooses its rows by itself: the run's samples, every `stride`-th state, and the first states of each
/// decade, so that short and long times are both seen. No state is kept.
class ThinnedLedger : public Observer {
 public:
  ThinnedLedger(const Model& model, ContactLoss contact, long stride) : ledger_(model, contact), stride_(stride) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override { ledger_.contact(lost); }

  const std::vector<LedgerRow>& rows() const { return ledger_.rows(); }
  bool contact_inferred() const { return ledger_.contact_inferred(); }

 private:
  Ledger ledger_;
  long stride_, seen_ = 0, next_ = 1;
};

/// Statistics over a long run of its residual r, the balance less the balance at the start (J).
struct ResidualStatistics {
  double energy_scale = 0;  // J: the largest kinetic energy, or change of gravitational or elastic energy
  double worst = 0;         // J, largest |r|
  double final = 0;         // J, r at the end
  double drift = 0;         // J/s, slope of the straight line through r, least squares
  double oscillation = 0;   // J, RMS deviation of r from that line
  /// log10 of the largest |r| over the run over that of its first tenth: 0 where r is bounded, 1 where it grows in
  /// proportion to time.
  double growth = 0;
  /// 1/s: the drag rate gamma that would take as much from the same motion, -(r(T) - r(0)) / integral of 2 K dt, since
  /// drag takes gamma m v^2 each second. Negative where energy is made.
  double equivalent_drag = 0;
};
ResidualStatistics residual_statistics(const std::vector<LedgerRow>& rows);

// Numerical damping: what a rule takes from an oscillation that nothing damps.

/// Minus the slope of y over t, least squares, of points (t, y), two at least: 1/s of logarithms over seconds.
double decay_rate(std::span<const std::pair<double, double>> points);

/// 1 kg on a spring of 100 N/m without gravity or drag, let go 1 mm off its length.
Scene undamped_oscillator();
inline constexpr double oscillator_omega = 10;  // rad/s

/// The drag rate (1/s) that a rule's damping of an oscillation amounts to, at h omega per step: -2 ln|R(i h omega)| / h
/// with its stability function R; 0 of symplectic rules. Negative where energy is made. Empty for rules without one.
std::optional<double> damping_by_theory(const Method& method, double h, double omega);

/// The same from a run of `steps` steps: minus the slope of ln(energy) over time, least squares. Empty where the method
/// does not take the scene.
struct MeasuredDamping {
  Outcome outcome;
  std::optional<double> rate;  // 1/s
};
MeasuredDamping measured_damping(const Method& method, double h, int steps);

/// Table energy-damping: both, over a range of steps, for every method with fixed steps.
void add_damping(const Method& method, bool full, TableSet& tables);

}  // namespace crosscheck
