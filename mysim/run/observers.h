// Observers of a run: samples (Recorder), energies and losses (Ledger), and divergence (DivergenceMonitor).
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

struct Trajectory {
  std::vector<double> t;  // s
  std::vector<Points> x;  // frames of 3 x n, m
  std::vector<Points> v;  // frames of 3 x n, m/s, or of 3 x 0 in first-order scenes
  int frames() const { return static_cast<int>(t.size()); }
};

/// Root mean square of |a_i - b_i| over the particles (m).
double rms_distance(const Points& a, const Points& b);
/// Largest rms_distance() over the common samples up to `until` (s), in m.
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

/// Integral of equally spaced samples, to fourth order: Simpson's 3/8 rule over the first three steps, then the
/// Adams-Moulton weights (9, 19, -5, 1) h / 24.
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
  reported,  // by the engine
  inferred,  // not reported: the balance's residual counts as contact loss, so the balance proves nothing
  sampled,   // only samples are available: drag and air losses between them are estimated too
};

struct LedgerRow {
  double t;               // s
  Energy energy;          // J
  double drag, dashpots;  // J, dissipated by each since the start
  double contact;         // J, lost since the start by friction and impacts, minus the work of moving surfaces
  double wind, pins;      // J, work of the wind and of moved pins since the start
  double dissipated() const { return drag + dashpots; }
  /// total + dissipated + contact - wind - pins, J: constant up to the method's error.
  double balance() const { return energy.total() + dissipated() + contact - wind - pins; }
};

/// Records no row for states without velocities, which have no energy.
class Ledger : public Observer {
 public:
  Ledger(const Model& model, ContactLoss contact);
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  void contact(double lost) override { contact_ += lost; }

  const std::vector<LedgerRow>& rows() const { return rows_; }
  bool contact_inferred() const { return inferred_ || estimated_; }
  LedgerRow now(const State& state) const;
  double external_work() const { return wind_.value() + pins_.value(); }

 private:
  const Model& model_;
  bool inferred_;   // there are surfaces whose losses the engine does not report
  bool estimated_;  // integrals are from samples only
  Forces scratch_;
  Integral drag_, dashpots_, wind_, pins_;
  double contact_ = 0, last_t_ = 0;
  std::vector<LedgerRow> rows_;
};

// Bounds of a scene's true motion, accurate to a few per cent: enough to tell whether a run exceeds them tenfold.

struct MotionBounds {
  double speed = 0;    // m/s, largest of a free particle
  double stretch = 0;  // 1, largest ratio of a spring's length to its rest length (or initial length, if that is zero)
};

/// The ratio of MotionBounds::stretch at positions x; 0 without springs.
double largest_length_ratio(const Model& model, const State& start, const Points& x);

/// Simulates the run's duration with leapfrog at a quarter of its stability limit for the highest possible frequency,
/// where the speed of a vibration is accurate to 3 %. Returns nothing if leapfrog cannot run the scene, or fails.
std::optional<MotionBounds> motion_bounds_of(const Scene& scene, const Run& run);

using MotionBoundsFunction = std::function<std::optional<MotionBounds>(const Scene&, const Run&)>;

/// motion_bounds_of() for callers that run one scene repeatedly: keeps the bounds of the longest run, and for a shorter
/// run returns the bounds at its last sample.
class MotionBoundsCache {
 public:
  std::optional<MotionBounds> operator()(const Scene& scene, const Run& run);

 private:
  std::map<double, MotionBounds> until_;                        // by time, s
  double none_from_ = std::numeric_limits<double>::infinity();  // s; runs of at least this duration have no bounds
};

/// Verdict::energy if a free particle, by central differences of positions, is more than ten times as fast as any in
/// the true motion. Verdict::stretch if a spring, relative to its rest length, is more than ten times as long as any in
/// the true motion. The true motion (MotionBounds) is computed only if the run's own energy leaves the verdict open, in
/// about one run in twenty. The kinetic energy of the free particles by central differences is
///   K^_n = sum of m/2 |(x_{n+1} - x_{n-1}) / (t_{n+1} - t_{n-1})|^2,
/// and the energy available to the run is
///   B = K_0 + U_0 + max |change of gravitational energy| + max |work of wind and moved pins| + 2 h^2 sum of m |a_0|^2
/// (kinetic and elastic energy and accelerations at the start, plus what moving surfaces may contribute). A run is
///   in order while K^ <= B, and no spring is longer than three times the longest at the start or at rest,
///   blown up as soon as K^ > 1000 B,
///   otherwise compared with the true motion from the next sample on.
///
/// Reason for B: on a mode of frequency omega, leapfrog and symplectic Euler follow x_n = A cos(n theta + phi) with
/// sin(theta / 2) = h omega / 2, so v^_n^2 + omega^2 (1 - (h omega / 2)^2) x_n^2 is the same at every step. Hence K^ <=
/// 2 (K_0 + U_0) for every h omega < 2, while the energy itself oscillates by a factor 1 / (1 - (h omega / 2)^2),
/// entirely in the springs. Above the limit theta is complex, and K^ grows by a constant factor per step. B contains
/// neither Hooke's energy of links that a position-based rule leaves unsolved nor an engine's own velocities. Its last
/// part covers the speed that the first step gives before anything has moved (explicit Euler). Bounds of energy alone
/// do not suffice: a diverging nonlinear system may heat up to a moderate K^ and stay there, and a prestressed network,
/// or one that lies in a hollow, has far more energy than it can ever convert to motion.
/// tests/unit/experiments/verdict_trials.cpp counts wrong verdicts.
///
/// The monitor observes the states that every engine provides (verdict_stride, run.h): every step of most runs. Speeds
/// from states more than a step apart are mean velocities, which are no larger, so no good run is condemned. Motion
/// that reverses between two states shows only in lengths and non-finite numbers. If the true motion is unknown (hard
/// distances; a monitor without a scene), a run fails at K^ > 10 B, or at thirty times the initial length.
///
/// Verdict::frozen if by the first sample no free particle has moved or gained speed by even one bit, although a free
/// particle that touches no surface was accelerated at the start: an engine that dropped its forces, or put a body to
/// sleep. (Not checked under hard distances, whose forces may balance.)
class DivergenceMonitor : public Observer {
 public:
  /// Scene and run must outlive the monitor. `bounds` computes the bounds of the true motion.
  DivergenceMonitor(const Scene& scene, const Run& run, MotionBoundsFunction bounds = motion_bounds_of);
  /// For callers that know only the model. The initial energy is that of `start`, for engines that may not report
  /// velocities; without `start`, that of the first observed state.
  explicit DivergenceMonitor(const Model& model, const State* start = nullptr);
  bool between_samples() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  /// True if the verdict depends on the state at time t (s), regardless of other observers.
  bool due(double t) const { return !begun_ || t - last_.t >= (1 - 1e-6) * interval_; }

  double largest_ratio() const { return largest_ratio_; }
  /// Ratio to the true motion's speed or length above which a run fails.
  static constexpr double allowed = 10;
  /// Bounds of K^ / B: in order up to the first; failed above the second if no true motion is known; blown up above the
  /// third.
  static constexpr double ratio_in_order = 1, ratio_suspect = 10, ratio_blown_up = 1000;
  /// Bound on spring lengths, relative to the longest initial length or rest length.
  static constexpr double length_bound = 3;

 private:
  struct Seen {
    double t = 0;  // s
    Points x;      // m
  };
  void begin(const State& state);
  bool frozen(const State& state);
  /// Compares the state with the one before the last. Also fails if a part of B is not finite.
  Verdict moves_too_fast(const State& state);
  /// Verdict at a sample, by lengths, and by the true motion if needed.
  Verdict goes_too_far();
  Verdict beyond_bounds() const;

  const Model& model_;
  std::function<std::optional<MotionBounds>()> true_motion_bounds_;  // empty if only the model is known
  std::optional<MotionBounds> bounds_;                               // once computed
  std::optional<State> start_;
  std::optional<Ledger> ledger_;  // if wind or moved pins do work
  std::optional<State> first_;    // state at the first sample, kept until the next sample
  double interval_ = 0;           // s, between states that are due; 0 if all are due
  bool freeze_checked_ = false;
  bool begun_ = false;
  Seen before_, last_;
  int seen_ = 0;
  double moving_surface_energy_ = 0;  // J, largest contribution of moving surfaces
  double contact_energy_ = 0;         // J, largest contribution of corrections at contacts
  double initial_energy_ = 0;         // J, kinetic and elastic at the start, plus the two contributions above
  double initial_gravitational_ = 0;  // J, gravitational energy at the start
  double gravitational_change_ = 0;   // J, largest change of gravitational energy so far
  double external_work_ = 0;          // J, largest work of wind and moved pins so far
  double squared_acceleration_ = 0;   // kg m^2/s^4, sum of m |a_0|^2
  double squared_rounding_ = 0;       // kg m^2, sum of m/2 |rounding of a position|^2
  double contact_speed_ = 0;          // m/s, possible speed of a resting particle after a contact correction
  double position_rounding_ = 0;      // m
  double largest_ratio_ = 0;
  double largest_speed_ = 0;         // m/s, of a free particle, minus possible rounding
  double initial_length_ratio_ = 1;  // largest length ratio at the start, at least 1
  double largest_length_ratio_ = 0;
};

/// Combines other observers with a monitor. The monitor sees the same states even if others observe every step, so that
/// these observers never change a verdict.
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
