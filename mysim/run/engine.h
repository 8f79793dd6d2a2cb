// The run loop that all engines share, and the in-house engine: a stepper, moved pins and contacts over a scene.
#pragma once

#include "mysim/run/contacts.h"
#include "mysim/run/run.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

/// A scene inside an engine, stepped from outside.
class World {
 public:
  /// The work of the steps so far.
  struct Work {
    long evaluations = 0;            // of the right-hand side
    long degenerate_springs = 0;     // springs met at zero length, summed over the evaluations
    std::optional<long> steps = {};  // accepted by a world that chooses its own; of others the run loop counts them
    double worker_seconds = 0;       // s, CPU time of threads other than the one that steps
    bool single_precision = false;
  };

  virtual ~World() = default;
  /// Advances from t to t_next (s), pins and contacts included.
  virtual void step(double t, double t_next) = 0;
  /// Positions and velocities now, in the scene's numbering; t is what the caller knows.
  virtual const State& state(double t) = 0;
  /// Reports to the observer what the contacts of the last step took, where the engine knows it.
  virtual void report_contact(Observer& /*observer*/) {}
  /// The scene as the engine built it, read once after the first step.
  virtual std::optional<Readback> read_back() { return std::nullopt; }
  virtual Work work() const { return {}; }
  /// Whether the world crosses any interval in steps of its own: the run's step is then only the grid of what
  /// observers of every step are shown.
  virtual bool chooses_steps() const { return false; }
};

/// Steps the world over the run: the same times, observers and clock for every engine. CPU time is that of World::step
/// alone.
Outcome run_loop(World& world, const Run& run, Observer& observer);

/// The code that steps a scene: on regular cloths the fused step, reproducible (the same bits with AVX2 and AVX-512),
/// as fast as the machine can, or in single precision; `general` is the engine for any scene.
enum class ExecutionPath { reproducible, fastest, single_precision, general };

struct Execution {
  ExecutionPath path = ExecutionPath::reproducible;
  int threads = 1;  // at most: small cloths are stepped by fewer; the same bits, however many
};

/// Runs the scene, at run.step or, where the stepper is adaptive, to run.tolerance. Throws Unsupported with the reason
/// when the stepper does not take the scene.
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution = {});

}  // namespace crosscheck
