// Observers of a run: samples (Recorder), energies and losses (Ledger), and whether it diverges (DivergenceMonitor).
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mysim/model/energy.h"
#include "mysim/run/run.h"

namespace crosscheck {

// Samples of one run, and the observer that gathers them.

struct Trajectory {
  std::vector<double> t;  // s
  std::vector<Points> x;  // frames of N (3 x n), m
  std::vector<Points> v;  // frames of N (3 x n), m/s; frames of 3 x 0 in first-order scenes
  int frames() const { return static_cast<int>(t.size()); }
};

/// sqrt of the mean over the particles of |a_i - b_i|^2, m.
double rms_distance(const Points& a, const Points& b);
/// Its largest value over the samples that both have, up to `until` (s), m.
double largest_rms_distance(const Trajectory& a, const Trajectory& b, double until = INFINITY);

class Recorder : public Observer {
 public:
  Verdict observe(const State& state, bool sample) override {
    if (sample) {
      trajectory.t.push_back(state.t);
      trajectory.x.push_back(state.x);
      trajectory.v.push_back(state.v);
    }
    return Verdict::ok;
  }
  Trajectory trajectory;
};

// The energy ledger: energies of a run, losses, work done on it, and the residual of the balance.

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
  reported,  // the engine reports what its contacts take
  inferred,  // it does not: what is missing from the balance is called contact loss, and no closure is claimed
  sampled,   // nor is more seen than samples: what drag and air took between them is an estimate, no closure either
};

struct LedgerRow {
  double t;               // s
  Energy energy;          // J
  double drag, dashpots;  // J, taken by them since the start
  double contact;         // J, lost in contact since the start: friction and impacts, less what moving surfaces gave
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
  /// What wind and moved pins have given so far, J.
  double external_work() const { return wind_.value() + pins_.value(); }

 private:
  const Model& model_;
  bool inferred_;   // a surface is there and the engine does not report its losses
  bool estimated_;  // integrals from samples alone
  Forces scratch_;
  Integral drag_, dashpots_, wind_, pins_;
  double contact_ = 0, last_t_ = 0;
  std::vector<LedgerRow> rows_;
};

// Bounds of a scene's true motion, good to some per cent: enough to see whether a run goes ten times as far.

struct MotionBounds {
  double speed = 0;    // m/s, the largest of a free particle
  double stretch = 0;  // 1, the largest length of a spring over its length at rest (at the start, where that is zero)
};

/// The largest length of a spring over its length at rest; 0 without springs.
double largest_length_ratio(const Model& model, const State& start, const Points& x);

/// Leapfrog over the run's duration at a quarter of its limit on the fastest vibration there can be, where a
/// vibration's speed is right to 3 %. Nothing where leapfrog does not take the scene, or fails.
std::optional<MotionBounds> motion_bounds_of(const Scene& scene, const Run& run);

using MotionBoundsFunction = std::function<std::optional<MotionBounds>(const Scene&, const Run&)>;

/// motion_bounds_of() for callers that run one scene again and again: of the longest of these runs, up to the sample at
/// which a shorter one has ended.
class MotionBoundsCache {
 public:
  std::optional<MotionBounds> operator()(const Scene& scene, const Run& run);

 private:
  std::map<double, MotionBounds> until_;                        // by time, s
  double none_from_ = std::numeric_limits<double>::infinity();  // s: runs of such a duration have none
};

// Detects a failed run: it moves ten times as fast, or makes a spring ten times as long, as the true motion ever
// does; or its state is not finite.

/// Verdict::energy when a free particle is faster than ten times the largest speed of the true motion, by central
/// differences of positions; Verdict::stretch when a spring is longer, over its length at rest, than ten times the
/// longest of the true motion. The true motion (observers.h) is computed only where the run's own energy leaves it
/// open, which is about one run in twenty. With the kinetic energy of the free particles by central differences,
///   K^_n = sum of m/2 |(x_{n+1} - x_{n-1}) / (t_{n+1} - t_{n-1})|^2,
/// and what the run had to work with,
///   B = K_0 + U_0 + max |change of gravitational energy| + max |work of wind and moved pins| + 2 h^2 sum of m |a_0|^2
/// (kinetic and elastic energy and accelerations at the start, and what moving surfaces may give), a run is
///   in order while K^ <= B, and no spring is longer than three times what the longest was at the start or at rest,
///   blown up when K^ > 1000 B, at once,
///   compared with the true motion from the next sample on otherwise.
///
/// Why B: on a mode of frequency omega leapfrog and symplectic Euler go through x_n = A cos(n theta + phi) with
/// sin(theta / 2) = h omega / 2, so that v^_n^2 + omega^2 (1 - (h omega / 2)^2) x_n^2 is the same at every step. Hence
/// K^ <= 2 (K_0 + U_0) for every h omega < 2, while the energy itself swings by 1 / (1 - (h omega / 2)^2): that swing
/// lies all in the springs. Above the limit theta is complex and K^ grows by a constant factor in every step. Hooke's
/// energy of links that a position-based rule leaves unsolved does not enter, nor does what an engine calls its
/// velocities. The last part of B is the speed that the first step gives before anything has moved (explicit Euler).
/// Bounds of energy alone do not do: what is not linear heats to some B and stays there, and a prestressed net or one
/// that lies in a hollow has far more energy than it can ever move with. tests/unit/experiments/verdict_trials.cpp
/// counts how often a verdict errs.
///
/// It observes the states that every engine shows (verdict_stride, run.h): every step of most runs. Where they are more
/// than a step apart, the differences are mean velocities, which are no larger: no good run is condemned, but motion
/// that only reverses between two states is detected by lengths and non-finite numbers alone. Where there is no true
/// motion (hard distances; a monitor without a scene) K^ > 10 B is a failure, and thirty times the length of the start.
///
/// Verdict::frozen when at the first sample no free particle has moved or gained speed, bit for bit, although one that
/// touches no surface was accelerated at the start: an engine that dropped its forces, or a body put to sleep. (Not
/// checked under hard distances, whose forces may balance.)
class DivergenceMonitor : public Observer {
 public:
  /// Of a run of the scene; both must outlive it. `bounds` gives those of the true motion.
  DivergenceMonitor(const Scene& scene, const Run& run, MotionBoundsFunction bounds = motion_bounds_of);
  /// Of a caller that knows no more than the model. The energy at the start is that of `start`, where engines may not
  /// report velocities; else of the first state shown.
  explicit DivergenceMonitor(const Model& model, const State* start = nullptr);
  bool between_samples() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  /// True if the verdict is based on the state at time t (s), whichever others are shown.
  bool due(double t) const { return !begun_ || t - last_.t >= (1 - 1e-6) * interval_; }

  /// The largest K^ / B so far.
  double largest_ratio() const { return largest_ratio_; }
  /// A run that has not failed goes less than so many times as fast and as far as the true motion.
  static constexpr double allowed = 10;
  /// Bounds of K^ / B: in order up to; without a true motion failed, with one blown up beyond.
  static constexpr double ratio_in_order = 1, ratio_suspect = 10, ratio_blown_up = 1000;
  /// The bound of lengths over the longest of the start, or of springs at rest.
  static constexpr double length_bound = 3;

 private:
  struct Seen {
    double t = 0;  // s
    Points x;      // m
  };
  void begin(const State& state);
  bool frozen(const State& state);
  /// By the state before the last; not ok either where a part of B is not finite.
  Verdict moves_too_fast(const State& state);
  /// At a sample: the verdict by lengths, and by the true motion where it is needed.
  Verdict goes_too_far();
  Verdict beyond_bounds() const;

  const Model& model_;
  std::function<std::optional<MotionBounds>()> true_motion_bounds_;  // none: only the model is known
  std::optional<MotionBounds> bounds_;                               // once computed
  std::optional<State> start_;
  std::optional<Ledger> ledger_;  // only where wind or moved pins do work
  std::optional<State> first_;    // until the sample after it
  double interval_ = 0;           // s, between two states that are due; 0: all are
  bool freeze_checked_ = false;   // whether frozen() was called
  bool begun_ = false;
  Seen before_, last_;  // the last two states shown
  int seen_ = 0;
  double moving_surface_energy_ = 0;  // J, the most that moving surfaces are expected to give
  double contact_energy_ = 0;         // J, the most that corrections at contacts are expected to give
  double initial_energy_ = 0;  // J, kinetic and elastic at the start and what moving surfaces and contacts may give
  double initial_gravitational_ = 0;  // J, gravitational at the start
  double gravitational_change_ = 0;   // J, the largest change of it
  double external_work_ = 0;          // J, the largest work of wind and moved pins so far
  double squared_acceleration_ = 0;   // kg m^2/s^4, sum of m |a_0|^2
  double squared_rounding_ = 0;       // kg m^2, sum of m/2 |rounding of a position|^2
  double contact_speed_ = 0;          // m/s, that a correction at a contact may give to a particle at rest
  double position_rounding_ = 0;      // m, of a position
  double largest_ratio_ = 0;
  double largest_speed_ = 0;         // m/s, of a free particle, less what roundings may be
  double initial_length_ratio_ = 1;  // 1, the longest spring of the start, or 1
  double largest_length_ratio_ = 0;  // 1
};

/// Other observers and a monitor as one. The monitor sees the same states whichever other observers see every step, so
/// that other observers change no verdict.
class MonitoredObservers : public Observer {
 public:
  MonitoredObservers(DivergenceMonitor& monitor, std::vector<Observer*> others)
      : monitor_(monitor), others_(std::move(others)) {}
  bool every_step() const override;
  bool between_samples() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override;

 private:
  DivergenceMonitor& monitor_;
  std::vector<Observer*> others_;
};

}  // namespace crosscheck
