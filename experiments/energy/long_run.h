// Long runs: drift, oscillation and growth of the energy residual, and numerical damping.
#pragma once

#include <optional>
#include <string>

#include "experiments/experiment.h"
#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// A ledger that includes every step, but keeps few rows: those of the samples, of every `stride`-th state, and of
/// states at indices that grow by a factor of 1.12, so that both short and long times are visible. Keeps no states.
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

/// Statistics of the residual r (J) over a long run. r is the energy balance minus its value at the start.
struct ResidualStatistics {
  double energy_scale = 0;  // J, largest kinetic energy, or largest change of gravitational or elastic energy
  double worst = 0;         // J, largest |r|
  double final = 0;         // J, r at the end
  double drift = 0;         // J/s, slope of the least-squares line through r
  double oscillation = 0;   // J, RMS deviation of r from that line
  /// log10 of the ratio of the largest |r| of the whole run to that of its first tenth: 0 if r is bounded, 1 if it
  /// grows linearly.
  double growth = 0;
  /// Drag rate gamma (1/s) that would dissipate as much in the same motion: -(r(T) - r(0)) / integral of 2 K dt,
  /// because drag dissipates gamma m v^2 per second. Negative if energy is created.
  double equivalent_drag = 0;
};
ResidualStatistics residual_statistics(const std::vector<LedgerRow>& rows);

/// Negative least-squares slope of y as a function of t for at least two points (t, y); in 1/s if y is a logarithm and
/// t is in seconds.
double decay_rate(std::span<const std::pair<double, double>> points);

/// A mass of 1 kg on a spring of 100 N/m, without gravity and drag, released 1 mm from the rest length.
Scene undamped_oscillator();
inline constexpr double oscillator_omega = 10;  // rad/s

/// Drag rate (1/s) equivalent to a rule's numerical damping at step h: -2 ln|R(i h omega)| / h with the rule's
/// stability function R; 0 for symplectic rules, negative if energy is created. Returns nullopt for rules without a
/// stability function.
std::optional<double> damping_by_theory(const Method& method, double h, double omega);

/// Drag rate from a run: negative least-squares slope of ln(energy) over time. Empty if the method does not support the
/// scene.
struct MeasuredDamping {
  Outcome outcome;
  std::optional<double> rate;  // 1/s
};
MeasuredDamping measured_damping(const Method& method, double h, int steps);

/// Adds table energy-damping for a method with fixed steps: the drag rates by theory and by measurement over a range of
/// steps.
void add_damping(const Method& method, bool full, TableSet& tables);

}  // namespace crosscheck
