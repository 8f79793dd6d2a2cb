// The run loop that all engines share, and the in-house engine: a stepper, moved pins and contacts over a scene.
#pragma once

#include "mysim/run/contacts.h"
#include "mysim/run/run.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

// The run loop that all engines share: same plan, same times, same observers, same clock.

/// A scene inside an engine, stepped from outside.
class World {
 public:
  virtual ~World() = default;
  /// Advances from t to t_next (s), pins and contacts included.
  virtual void step(double t, double t_next) = 0;
  /// Positions and velocities now, in the scene's numbering; t is what the caller knows.
  virtual const State& state(double t) = 0;
  /// Tells the observer what the contacts of the last step took, where the engine knows it.
  virtual void report_contact(Observer& /*observer*/) {}
  /// What the engine says of the scene it built, asked once after the first step.
  virtual std::optional<Readback> read_back() { return std::nullopt; }
};

/// Steps the world over the run. Fills verdict, reason, end, step, steps, cpu_seconds and readback of the outcome; CPU
/// time is that of World::step alone.
Outcome run_loop(World& world, const Run& run, Observer& observer);

// The run loop of worlds that choose their own steps, whoever integrates.

/// Marches the world and fills what adaptive methods report besides: evaluations, steps accepted, their mean and the
/// tolerance. The fixed step of the run is only the grid on which observers of every step look (and, where
/// keep_grid says so, what bounds the world's own steps).
template <class AdaptiveWorld>  // a World with right_hand_side() and accepted()
Outcome run_adaptive_loop(AdaptiveWorld& world, const Run& run, Observer& observer, bool keep_grid = false) {
  Run seen = run;
  if (!observer.every_step() && !keep_grid) seen.step = run.duration / run.samples;
  Outcome out = run_loop(world, seen, observer);
  out.evaluations = world.right_hand_side().evaluations();
  out.degenerate_springs = world.right_hand_side().degenerate_springs();
  out.steps = world.accepted();
  out.step = out.steps > 0 ? out.end / static_cast<double>(out.steps) : 0;
  out.tolerance = run.tolerance;
  return out;
}

// A scene stepped by the pair of Dormand and Prince under error control.

/// Steps are chosen so that the root mean square of (estimated error of a step) / (R (scene size + |x|)), and likewise
/// of velocities with the largest speed so far for the scene's size, stays at or below 1, with R = run.tolerance. The
/// states that are asked for lie on the interpolant. Beside a sphere no step goes beyond the next state asked for,
/// since contact acts on whole steps; it may take several to get there, and each may touch.
class AdaptiveWorld : public World {
 public:
  AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact);
  void step(double t, double t_next) override;
  /// On the interpolant; looked at outside the clock, so that only the steps cost.
  const State& state(double t) override;
  void report_contact(Observer& observer) override {
    if (lost_) observer.contact(*lost_);
  }

  const System& right_hand_side() const { return f_; }
  long accepted() const { return accepted_; }

 private:
  double error_ratio();
  void advance(double limit);

  const Scene& scene_;
  System f_;
  Contacts contacts_;
  DormandPrince pair_;
  double tolerance_, h_, last_h_ = 0;
  double fastest_;            // m/s, largest speed of an accepted state
  double last_ratio_ = 1e-4;  // of the step before, for the controller
  State before_, s_, seen_;   // start and end of the last accepted step; what was asked for
  long accepted_ = 0;
  std::optional<double> lost_;  // J, in contacts on the way to the last state asked for
};

// The in-house engine: a stepper, the prescribed pins and the contacts, run over a scene.

/// How mysim computes: on regular cloths reproducible (the same bits with AVX2 and AVX-512), as fast as the machine
/// can, or in single precision; plain is the general engine, whatever the scene.
enum class Precision { reproducible, fastest, single, plain };

struct Execution {
  Precision precision = Precision::reproducible;
  int threads = 1;  // at most: small cloths are stepped by fewer; the same bits, however many
};

/// Runs the scene, at run.step or, where the stepper is adaptive, to run.tolerance. Throws Unsupported with the reason
/// when the stepper does not take the scene.
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution = {});

}  // namespace crosscheck
