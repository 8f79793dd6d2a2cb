// The largest stable step of a method on a scene: as linear theory predicts it, and as perturbed runs measure it.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "experiments/stability/spectrum.h"
#include "experiments/tables/stability.h"
#include "reference/method.h"

namespace crosscheck {

// The largest stable step that theory allows a rule on a scene: the least over the scene's modes.

/// True for Runge-Kutta rules, which see f(X, t) alone and multiply every eigenvector of the Jacobian by R(h lambda).
inline bool is_runge_kutta(const Stepper& rule) { return rule.first_order; }

struct PredictedLimit {
  double limit = 0;     // s; 0: no step is stable; infinite: every step is
  int mode = -1;        // of the spectrum's, the one that binds; -1: none, or not identified
  std::string missing;  // why there is no prediction; empty where there is one
};
/// The minimum of the rule's limit over the modes. Where damping and stiffness do not commute: Runge-Kutta rules take
/// the eigenvalues of the first-order Jacobian one by one; symplectic Euler is stable while 4 - h^2 K - 2 h C is
/// positive definite (in w'(4 - h^2 K - 2 h C) w both conditions of a single mode hold for every w, and where it is
/// singular there is an eigenvalue -1); leapfrog while 4 - h^2 K is, if there are no dashpots; the others by the
/// largest eigenvalue of their step matrix, up to 90 free coordinates. Where only the fastest rates are known, only
/// rules whose stability region is about as deep in all directions have a prediction: rk4's, to 12 %.
PredictedLimit predicted_limit(const Stepper& rule, const Spectrum& spectrum);

/// By the rule that the method follows; `missing` where it follows none, or only without what the scene has.
PredictedLimit predicted_limit(const Method& method, const Spectrum& spectrum);

// Runs that show whether a perturbation of the rest state grows.

/// The base state for a scene's stability: at rest where it has a rest, else as it starts.
struct BaseState {
  Scene scene;  // its start is the state
  bool at_rest = false;
  bool saddle = false;  // an equilibrium was found that is no rest, but a saddle
  Spectrum spectrum;    // about the state
  double spacing = 1;   // m, the shortest spring that has a length: the scale relative to which a perturbation is small
};
BaseState base_state_of(const Scene& scene);

struct Perturbation {
  int mode = -1;         // of the spectrum's; -1: the fastest shape of the stiffness
  double size = 1.5e-8;  // of the shortest spring: at the root of the rounding, rounding (eps / size in a step) and
                         // nonlinearity (size) disturb linear motion equally
};

struct PerturbedRun {
  Verdict verdict = Verdict::ok;
  std::string reason;
  double end = 0;        // s
  double growth = 0;     // of the norm sqrt(|w'|^2 + w K w), from the first to the last tenth of the run; 0: unknown
  double per_step = 1;   // of the perturbed mode's amplitude (a rotation's |x|): the mean factor; 1 where unknown
  double amplitude = 1;  // of the perturbed mode, at the end over at the start
  long steps = 0;        // taken, where the two above are known
  bool of_mode = false;  // whether the two above are known
  bool unsupported() const { return verdict == Verdict::unsupported; }
  /// Whether the method refuses the step, or its program died or took too long: that tells nothing of stability.
  bool without_answer() const { return unsupported() || verdict == Verdict::crash || verdict == Verdict::timeout; }
  /// Whether the step held: no failure, and nothing that grew. A perturbed rest is judged by growth too: by 1/20
  /// over the run (beats of a neutral rule's modes look like a thousandth), and, where a Runge-Kutta rule multiplies
  /// the mode by a constant factor, by that factor: rounding and nonlinearity change a perturbation by 1e-6 over a run,
  /// and what grows by less than 1e-9 in a step is called neutral however long one looks.
  bool held() const;
  /// The verdict, or `energy` where the run ended before what grew had more energy than the monitor allows.
  Verdict effective_verdict() const { return verdict == Verdict::ok && !held() ? Verdict::energy : verdict; }
};

/// Runs the method from the base state, perturbed (or from the start, unperturbed, where the scene has no rest).
/// Further observers observe the run too; `bounds` gives those of its true motion.
PerturbedRun run_perturbed(const Method& method, const BaseState& base, double h, long steps, Perturbation perturbation,
                           std::vector<Observer*> observers = {},
                           const MotionBoundsFunction& bounds = motion_bounds_of);
/// The times and samples of such a run.
Run run_of_perturbed(double h, long steps);
/// The base scene with the perturbation in its start.
Scene perturbed_scene(const BaseState& base, const Perturbation& perturbation);

/// The largest step that `holds`: doubled and halved from `first` until one holds and one fails, then halved in the
/// logarithm until failed / held - 1 <= precision. Not below `lowest`, not above `highest`; from `fine_above` to five
/// times that upwards in tenths.
MeasuredLimit largest_step(const std::function<bool(double)>& holds, double first, double lowest, double highest,
                           double precision, double fine_above = std::numeric_limits<double>::infinity());
/// The same by trials of the method, from the scene's own step on: it uses no theory for the limit. Where theory
/// says how fast the scene can vibrate, that only says where to give up. A step without an answer counts as none that
/// holds; where the bracket ends at such a one it is no limit but `refused_above`, and where every step was refused the
/// scene is `unsupported`.
MeasuredLimit measured_limit(const Method& method, const BaseState& base, long steps, Perturbation perturbation,
                             double precision);

}  // namespace crosscheck
