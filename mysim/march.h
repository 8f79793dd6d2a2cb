// The run loop that all engines share: same plan, same times, same observers, same clock.
#pragma once

#include "mysim/run.h"

namespace crosscheck {

/// A scene inside an engine, stepped from outside.
class World {
 public:
  virtual ~World() = default;
  /// Advances from t to t_next (s), pins and contacts included.
  virtual void step(double t, double t_next) = 0;
  /// Positions and velocities now, in the scene's numbering; t is what the caller knows.
  virtual const State& state(double t) = 0;
  /// Tells the observer what the contacts of the last step took, where the engine knows it.
  virtual void tell_contact(Observer& /*observer*/) {}
  /// What the engine says of the scene it built, asked once after the first step.
  virtual std::optional<Readback> read_back() { return std::nullopt; }
};

/// Steps the world over the run. Fills verdict, reason, end, step, steps, cpu_seconds and readback of the outcome; CPU
/// time is that of World::step alone.
Outcome march(World& world, const Run& run, Observer& observer);

}  // namespace crosscheck
