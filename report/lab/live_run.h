// A run of mysim that can be inspected and changed while it goes on, as in the page's lab.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mysim/run/engine.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// A scene and a run. A change by hand replaces the scene by one that starts from the run's present state at time 0.
class LiveRun {
 public:
  struct Settings {
    std::string rule;  // a stepper with options: "leapfrog", "implicit-euler+linear", "rk4+sticky"
    double step;       // s, upper bound
    double tolerance;  // for adaptive rules
    double duration;   // s; the sampling interval is that of the scene, and the run ends at the last sample
    bool keep_ledger;  // true: accumulate losses and work, which requires observing every step
  };

  explicit LiveRun(Scene scene) : scene_(std::move(scene)) {}

  const Scene& scene() const { return scene_; }
  /// Fastest vibration in the scene's initial state, rad/s; 0 if nothing vibrates.
  double omega() const;
  /// Largest stable step (s) of a stepper for that vibration: 0 if no step is stable, infinity if all steps are stable.
  /// Returns nullopt if the limit is unknown (first-order scenes, different drag rates, adaptive rules).
  std::optional<double> critical_step(const Stepper& stepper) const;

  /// Restarts from the scene's initial state. Throws InputError for an unknown rule, and Unsupported with the reason if
  /// the rule does not support the scene.
  void start(const Settings& settings);
  /// Steps until time t (s) or the end of the run, but takes at most `most` steps. Returns false if the run has ended.
  bool advance(double t, int most);
  double time() const { return loop_->time(); }  // s
  Outcome outcome() const { return loop_->outcome(); }
  const State& state() const { return world_->state(time()); }
  /// Energies, losses and work, J; nullopt for first-order scenes. Without a ledger, losses and work are nan.
  std::optional<LedgerRow> energies() const;

  /// Pins a free particle at a position (m), as if held by hand.
  void hold(int particle, const Vec3& place);
  void release();
  /// Pins a particle at its present position, or releases it.
  void set_pinned(int particle, bool pinned);

  std::string fingerprint() const { return crosscheck::fingerprint(state()); }

 private:
  /// Makes the present state the initial one, applies `change`, and starts a run.
  template <class Change>
  void go_on(const Change& change);
  void begin();

  Scene scene_;
  mutable std::optional<double> omega_;  // cached
  MotionBoundsCache bounds_;
  int held_ = -1;  // particle held by hand
  Stepper rule_{};
  ContactRule contact_ = ContactRule::coulomb;
  Run run_{};
  bool keep_ledger_ = false;
  // in the order in which they depend on each other
  std::unique_ptr<DivergenceMonitor> monitor_;
  std::unique_ptr<Ledger> ledger_;
  std::unique_ptr<MonitoredObservers> observers_;
  std::unique_ptr<World> world_;
  std::unique_ptr<RunLoop> loop_;
};

}  // namespace crosscheck
