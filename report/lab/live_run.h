// A run of mysim that is looked at while it goes on and changed by hand: what the page's lab steps.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mysim/run/engine.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// A scene, and one run of it. What is changed by hand makes another scene of it: one that starts where the run stands,
/// with its clock at 0.
class LiveRun {
 public:
  struct Settings {
    std::string rule;  // a stepper and its options: "leapfrog", "implicit-euler+linear", "rk4+sticky"
    double step;       // s, at most
    double tolerance;  // of adaptive rules
    double duration;   // s; the sampling interval stays the scene's, and the run ends at the last sample
    bool keep_ledger;  // whether losses and work are added up, which takes a look at every step
  };

  explicit LiveRun(Scene scene) : scene_(std::move(scene)) {}

  const Scene& scene() const { return scene_; }
  /// The fastest vibration at the scene's start, rad/s; 0 where nothing vibrates.
  double omega() const;
  /// The largest stable step of a stepper on that vibration, s: 0 where none is, infinite where all are, nothing where
  /// it cannot be told (first-order scenes, drag rates that differ, adaptive rules).
  std::optional<double> critical_step(const Stepper& stepper) const;

  /// Begins the run again at the scene's start. Throws InputError on a rule that there is none of, Unsupported with the
  /// reason where it does not take the scene.
  void start(const Settings& settings);
  /// Steps until the run's time is t (s) or later, the run has ended, or so many steps were taken. False when it has
  /// ended.
  bool advance(double t, int most);
  double time() const { return loop_->time(); }  // s
  /// What the run has come to so far.
  Outcome outcome() const { return loop_->outcome(); }
  const State& state() const { return world_->state(time()); }
  /// Energies, losses and work, J; none in first-order scenes. Without a ledger losses and work are nan.
  std::optional<LedgerRow> energies() const;

  /// Holds a free particle at a place (m) from now on, as by a hand: it is pinned there, and the run goes on.
  void hold(int particle, const Vec3& place);
  /// Lets go of the particle that hold() has.
  void release();
  /// Pins a particle where it is, or lets it go.
  void set_pinned(int particle, bool pinned);

  std::string fingerprint() const { return crosscheck::fingerprint(state()); }

 private:
  /// Makes the present state the scene's start, lets `change` change it, and begins a run there.
  template <class Change>
  void go_on(const Change& change);
  void begin();

  Scene scene_;
  mutable std::optional<double> omega_;  // once computed, as the bounds
  MotionBoundsCache bounds_;
  int held_ = -1;  // the particle that a hand has
  Stepper rule_{};
  ContactRule contact_ = ContactRule::coulomb;
  Run run_{};
  bool keep_ledger_ = false;
  // in the order in which they refer to each other
  std::unique_ptr<DivergenceMonitor> monitor_;
  std::unique_ptr<Ledger> ledger_;
  std::unique_ptr<MonitoredObservers> observers_;
  std::unique_ptr<World> world_;
  std::unique_ptr<RunLoop> loop_;
};

}  // namespace crosscheck
