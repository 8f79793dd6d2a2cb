// A run of mysim that can be inspected and changed while it goes on: the page's lab steps it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mysim/run/engine.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// A scene, and one run of it. A change by hand replaces the scene by one that starts from the present state of the
/// run, with its clock at 0.
class LiveRun {
 public:
  struct Settings {
    std::string rule;  // a stepper and its options: "leapfrog", "implicit-euler+linear", "rk4+sticky"
    double step;       // s, upper bound
    double tolerance;  // for adaptive rules
    double duration;   // s; the sampling interval stays the scene's, and the run ends at the last sample
    bool keep_ledger;  // accumulates losses and work, which requires observing every step
  };

  explicit LiveRun(Scene scene) : scene_(std::move(scene)) {}

  const Scene& scene() const { return scene_; }
  /// The fastest vibration in the scene's initial state, rad/s; 0 if nothing vibrates.
  double omega() const;
  /// The largest stable step of a stepper for that vibration, s. It is 0 if no step is stable and infinite if all are.
  /// Empty if unknown (first-order scenes, different drag rates, adaptive rules).
  std::optional<double> critical_step(const Stepper& stepper) const;

  /// Restarts the run from the scene's initial state. Throws InputError for an unknown rule, Unsupported with the
  /// reason if the rule does not support the scene.
  void start(const Settings& settings);
  /// Steps until the run's time is t (s) or later, the run has ended, or `most` steps were taken. Returns false if the
  /// run has ended.
  bool advance(double t, int most);
  double time() const { return loop_->time(); }  // s
  /// The outcome of the run so far.
  Outcome outcome() const { return loop_->outcome(); }
  const State& state() const { return world_->state(time()); }
  /// Energies, losses and work, J; empty for first-order scenes. Without a ledger, losses and work are nan.
  std::optional<LedgerRow> energies() const;

  /// Holds a free particle at a position (m) from now on, as if by hand: pins it there, and the run goes on.
  void hold(int particle, const Vec3& place);
  /// Releases the particle that hold() holds.
  void release();
  /// Pins a particle at its present position, or releases it.
  void set_pinned(int particle, bool pinned);

  std::string fingerprint() const { return crosscheck::fingerprint(state()); }

 private:
  /// Makes the present state the scene's initial state, applies `change`, and starts a run from there.
  template <class Change>
  void go_on(const Change& change);
  void begin();

  Scene scene_;
  mutable std::optional<double> omega_;  // cached, like the bounds
  MotionBoundsCache bounds_;
  int held_ = -1;  // the particle held by hand
  Stepper rule_{};
  ContactRule contact_ = ContactRule::coulomb;
  Run run_{};
  bool keep_ledger_ = false;
  // declared in the order of their dependencies
  std::unique_ptr<DivergenceMonitor> monitor_;
  std::unique_ptr<Ledger> ledger_;
  std::unique_ptr<MonitoredObservers> observers_;
  std::unique_ptr<World> world_;
  std::unique_ptr<RunLoop> loop_;
};

}  // namespace crosscheck
