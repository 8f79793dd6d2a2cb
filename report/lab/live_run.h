// A run that a reader steps, stops and changes: the same world, loop, ledger and monitor as those of every other run.
// Compiled for the program and, as WebAssembly, for the page.
#pragma once

#include <cstdint>

#include "mysim/run/engine.h"
#include "mysim/run/observers.h"

namespace crosscheck {

struct LiveSettings {
  const Stepper* stepper;
  double step;      // s, at most; it is reduced so that it divides the time between two samples
  double duration;  // s
  ContactRule contact = ContactRule::coulomb;
};

class LiveRun {
 public:
  /// Keeps a copy of the scene. Throws Unsupported where the stepper does not take it, InputError where the step is no
  /// step.
  LiveRun(Scene scene, const LiveSettings& settings);
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// At most so many steps; how many were taken. Fewer: the run has ended, see outcome().
  int advance(int steps);
  const State& state() { return world_->state(loop_->time()); }
  Outcome outcome() { return loop_->outcome(); }
  const Ledger& ledger() const { return ledger_; }

 private:
  Scene scene_;
  Run run_;
  Ledger ledger_;
  DivergenceMonitor monitor_;
  MonitoredObservers observers_;
  std::unique_ptr<World> world_;
  std::unique_ptr<RunLoop> loop_;
};

/// Fingerprint of the exact bits of time, positions and velocities (FNV-1a).
std::uint64_t hash_of(const State& state);

}  // namespace crosscheck
