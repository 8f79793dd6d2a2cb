// The run loop shared by all engines, and mysim's engine: a stepper, moved pins and contacts applied to a scene.
#pragma once

#include <memory>

#include "mysim/base/this_process.h"
#include "mysim/run/contacts.h"
#include "mysim/run/run.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

/// A scene in an engine, stepped from outside.
class World {
 public:
  struct Work {
    long evaluations = 0;            // right-hand side evaluations
    long degenerate_springs = 0;     // springs at zero length, summed over the evaluations
    std::optional<long> steps = {};  // accepted steps, if the world chooses them; otherwise the run loop counts
    double worker_seconds = 0;       // s, CPU time of all threads but the stepping one
    bool single_precision = false;
  };

  virtual ~World() = default;
  /// Advances from t to t_next (s), including pins and contacts.
  virtual void step(double t, double t_next) = 0;
  /// Positions and velocities in the scene's numbering; `t` is the caller's current time (s).
  virtual const State& state(double t) = 0;
  /// Reports the energy lost in the contacts of the last step, if the engine knows it.
  virtual void report_contact(Observer& /*observer*/) {}
  /// The scene as the engine built it, read after the first step.
  virtual std::optional<Readback> read_back() { return std::nullopt; }
  virtual Work work() const { return {}; }
  /// True if the world chooses its own steps within an interval. The run's step then only defines the states for
  /// observers of every step.
  virtual bool chooses_steps() const { return false; }
};

/// A run that advances step by step, with the same times, observers and clock for every engine. Measures the CPU time
/// of World::step only.
class RunLoop {
 public:
  /// Passes the initial state to the observer. The arguments must outlive the loop.
  RunLoop(World& world, const Run& run, Observer& observer);
  /// Takes a step and passes it to the observer if due. Returns false, without a step, if the run has ended.
  bool step();
  bool ended() const { return sample_ >= grid_.samples || out_.verdict != Verdict::ok; }
  /// Time of the last state (s).
  double time() const { return out_.end; }
  /// The outcome of the run, after it has ended.
  Outcome outcome();

 private:
  static TimeGrid grid_of(World& world, const Run& run, const Observer& observer);

  World& world_;
  Observer& observer_;
  const Run run_;
  const bool every_step_;
  const TimeGrid grid_;
  const int stride_;  // steps between two observed states
  const bool chooses_steps_;
  CpuClock clock_;
  long evaluations_ = 0;       // count up to the last observed state, if the world chooses its steps
  int sample_ = 0, step_ = 0;  // samples so far, and steps since the last sample
  Outcome out_;
};

Outcome run_loop(World& world, const Run& run, Observer& observer);

/// Execution paths. The first three apply the fused step to regular cloths: with the same bits on every machine, as
/// fast as possible, or in single precision. `general` uses the general engine, which handles any scene.
enum class ExecutionPath { reproducible, fastest, single_precision, general };

struct Execution {
  ExecutionPath path = ExecutionPath::reproducible;
  int threads = 1;  // upper bound; small cloths use fewer. The number does not change the bits
};

/// For regular cloths, the world applies the fused step, which follows the same rule. Throws Unsupported with the
/// reason if the stepper cannot run the scene. Stepper and scene must outlive the world.
std::unique_ptr<World> make_world(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run,
                                  const Observer& observer, const Execution& execution = {});

/// Runs the scene at run.step or, with an adaptive stepper, to run.tolerance. Throws like make_world().
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution = {});

/// True for rules with a fixed order of summation; rules that solve equations or choose their steps may give different
/// bits on different machines.
inline bool has_same_bits_everywhere(const Stepper& rule) {
  return !rule.adaptive && (rule.evaluations > 0 || rule.hard_constraints);
}

/// FNV-1a over the bits of positions and velocities, 16 hexadecimal digits.
std::string fingerprint(const State& state);

}  // namespace crosscheck
