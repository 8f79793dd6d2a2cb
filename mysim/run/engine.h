// The run loop that all engines share, and the in-house engine: a stepper, moved pins and contacts over a scene.
#pragma once

#include <memory>

#include "mysim/base/this_process.h"
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

/// A run that is taken step by step: the same times, observers and clock for every engine. CPU time is that of
/// World::step alone.
class RunLoop {
 public:
  /// Shows the observer the start. All three must outlive the loop.
  RunLoop(World& world, const Run& run, Observer& observer);
  /// Takes a step and shows it to the observer, where it is to be shown. False when the run has ended: nothing is done.
  bool step();
  bool ended() const { return sample_ >= grid_.samples || out_.verdict != Verdict::ok; }
  /// s, of the last state.
  double time() const { return out_.end; }
  /// What the run has come to, once it has ended.
  Outcome outcome();

 private:
  static TimeGrid grid_of(World& world, const Run& run, const Observer& observer);

  World& world_;
  Observer& observer_;
  const Run run_;
  const bool every_step_;
  const TimeGrid grid_;
  const int stride_;  // steps between two states that the observer sees
  const bool chooses_steps_;
  CpuClock clock_;
  long evaluations_ = 0;       // at the last state seen, of a world that chooses its steps
  int sample_ = 0, step_ = 0;  // samples so far, and steps since the last
  Outcome out_;
};

/// The whole run.
Outcome run_loop(World& world, const Run& run, Observer& observer);

/// The code that steps a scene: on regular cloths the fused step, reproducible (the same bits on every machine),
/// as fast as the machine can, or in single precision; `general` is the engine for any scene.
enum class ExecutionPath { reproducible, fastest, single_precision, general };

struct Execution {
  ExecutionPath path = ExecutionPath::reproducible;
  int threads = 1;  // at most: small cloths are stepped by fewer; the same bits, however many
};

/// The world that steps the scene: the same rule in each case, on regular cloths the fused step. Throws Unsupported
/// with the reason when the stepper does not take the scene. Stepper and scene must outlive it.
std::unique_ptr<World> make_world(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run,
                                  const Observer& observer, const Execution& execution = {});

/// Runs the scene, at run.step or, where the stepper is adaptive, to run.tolerance. Throws Unsupported with the reason
/// when the stepper does not take the scene.
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution = {});

/// True if a rule gives the same bits on every machine: sums in one order do; solving equations and choosing steps need
/// not.
inline bool has_same_bits_everywhere(const Stepper& rule) {
  return !rule.adaptive && (rule.evaluations > 0 || rule.hard_constraints);
}

/// FNV-1a over the bits of positions and velocities, 16 hexadecimal digits: equal for equal states.
std::string fingerprint(const State& state);

}  // namespace crosscheck
