// The largest stable step of a method on a scene, predicted by linear theory and measured by perturbed runs.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "experiments/stability/spectrum.h"
#include "experiments/tables/stability.h"
#include "reference/method.h"

namespace crosscheck {

/// True for Runge-Kutta rules, which depend on f(X, t) only and multiply every eigenvector of the Jacobian by R(h
/// lambda).
inline bool is_runge_kutta(const Stepper& rule) { return rule.first_order; }

struct PredictedLimit {
  double limit = 0;     // s; 0 if no step is stable, infinite if every step is stable
  int mode = -1;        // index of the mode that determines the limit; -1 if none is identified
  std::string missing;  // reason if there is no prediction
};
/// The smallest limit of the rule for any mode. If damping and stiffness do not commute:
/// - Runge-Kutta rules use the individual eigenvalues of the first-order Jacobian.
/// - Symplectic Euler is stable while 4 - h^2 K - 2 h C is positive definite: for every w, the quadratic forms of K and
/// C meet both conditions for a single mode. Where the matrix becomes singular, the step has an eigenvalue -1.
/// - Leapfrog is stable while 4 - h^2 K is positive definite, if there are no dashpots.
/// - Other rules use the largest eigenvalue of their step matrix, up to 90 free coordinates.
/// If only the fastest rates are known, there is a prediction only for rules whose stability region has almost the same
/// depth in all directions, such as rk4 (to 12 %).
PredictedLimit predicted_limit(const Stepper& rule, const Spectrum& spectrum);

/// Prediction for the rule that the method follows. `missing` is set if the method follows no rule, or follows another
/// rule for the ingredients of this scene.
PredictedLimit predicted_limit(const Method& method, const Spectrum& spectrum);

/// The base state for a scene's stability: its equilibrium, or its initial state if there is none.
struct BaseState {
  Scene scene;  // starts in the base state
  bool at_rest = false;
  bool saddle = false;  // true if a saddle was found (and left, if at_rest)
  Spectrum spectrum;    // linearised about the base state
  double spacing = 1;   // m, length of the shortest spring of non-zero length: the scale for small perturbations
};
BaseState base_state_of(const Scene& scene);

struct Perturbation {
  int mode = -1;  // index of the mode; -1 for the fastest shape of the stiffness
  /// Size of the perturbation in units of `spacing`. At sqrt(eps), linear motion is disturbed equally by rounding (eps
  /// / size per step) and by nonlinearity (size).
  double size = 1.5e-8;
};

struct PerturbedRun {
  Verdict verdict = Verdict::ok;
  std::string reason;
  double end = 0;        // s
  double growth = 0;     // ratio of sqrt(|w'|^2 + w K w) in the last tenth of the run to the first tenth; 0: unknown
  double per_step = 1;   // mean factor per step of the perturbed mode's amplitude (|x| for a rotation); 1: unknown
  double amplitude = 1;  // final amplitude of the perturbed mode divided by its initial amplitude
  long steps = 0;        // number of steps if per_step and amplitude are known
  bool of_mode = false;  // true if per_step and amplitude are known
  bool unsupported() const { return verdict == Verdict::unsupported; }
  /// True if the method refused the step, or its program died or took too long, which says nothing about stability.
  bool without_answer() const { return unsupported() || verdict == Verdict::crash || verdict == Verdict::timeout; }
  /// True if the run neither failed nor grew. A perturbed rest may grow by up to 1/20 over the run (a neutral rule lets
  /// it grow by a thousandth, as its modes beat). If a Runge-Kutta rule multiplies the mode by a constant factor, this
  /// factor is also limited: rounding and nonlinearity change a perturbation by 1e-6 over a run, and a growth of less
  /// than 1e-9 per step counts as neutral, however long the run is.
  bool held() const;
  /// The verdict, or `energy` if a growing motion ended before it reached the energy limit of the monitor.
  Verdict effective_verdict() const { return verdict == Verdict::ok && !held() ? Verdict::energy : verdict; }
};

/// Runs the method from the perturbed base state (from the unperturbed start if the scene has no rest). `bounds`:
/// bounds of the true motion.
PerturbedRun run_perturbed(const Method& method, const BaseState& base, double h, long steps, Perturbation perturbation,
                           std::vector<Observer*> observers = {},
                           const MotionBoundsFunction& bounds = motion_bounds_of);
Run run_of_perturbed(double h, long steps);
Scene perturbed_scene(const BaseState& base, const Perturbation& perturbation);

/// The largest step for which `holds` returns true. Doubles and halves from `first` until one step holds and one fails,
/// then bisects in the logarithm until failed / held - 1 <= precision. Stays between `lowest` and `highest`. Between
/// `fine_above` and five times that value, increases the step by a factor of 1.1 instead of 2.
MeasuredLimit largest_step(const std::function<bool(double)>& holds, double first, double lowest, double highest,
                           double precision, double fine_above = std::numeric_limits<double>::infinity());
/// Measures the largest stable step by trials, starting from the scene's own step. Theory only determines where the
/// search ends (by the scene's fastest vibration). A step without an answer counts as failed. If the bracket ends at
/// such a step, the result is `refused_above` instead of a limit; if every step was refused, it is `unsupported`.
MeasuredLimit measured_limit(const Method& method, const BaseState& base, long steps, Perturbation perturbation,
                             double precision);

}  // namespace crosscheck
