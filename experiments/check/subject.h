// The engine under test: its runs, and a bound on the effect of rounding errors on them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// Thrown if the relation does not apply to the engine. what(): the reason, one sentence without a full stop.
struct CannotBeAsked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if a run that a relation needs ended early. what(): the cause.
struct RunFailed : std::runtime_error {
  RunFailed(const std::string& how, double at, Verdict what) : std::runtime_error(how), end(at), verdict(what) {}
  double end;  // s
  Verdict verdict;
};

struct SubjectRun {
  Outcome outcome;
  Trajectory path;
};

/// The scene's own step, duration and samples. Adaptive rules get a tolerance of 1e-9, because their errors are larger
/// than rounding errors.
Run run_for_relations(const Scene& scene);

class Subject {
 public:
  explicit Subject(Method method) : method_(std::move(method)) {}
  const Method& method() const { return method_; }

  /// Computes each run only once. Throws CannotBeAsked if the engine refuses the scene, and RunFailed if the run fails.
  const SubjectRun& run(const Scene& scene, const Run& run);
  const SubjectRun& run(const Scene& scene) { return this->run(scene, run_for_relations(scene)); }
  SubjectRun fresh_run(const Scene& scene, const Run& run);

  /// Half the distance from 1 to the next number in the engine's precision. The method declares the precision, or it is
  /// read back from the engine; by default, double precision.
  double unit_roundoff() const;

  /// Largest distance that rounding may cause between two runs up to each sample, m (and m/s). Every step rounds
  /// positions in about ten operations, each to u L, with the unit round-off u and the lengths L that occur. The
  /// roundings of n steps add up like a random walk: 10 u L sqrt(n). For an adaptive rule, this error is replaced by
  /// its tolerance per step. The free particles are perturbed by that distance in two seeded directions, with both
  /// signs. The largest distance of a particle from its unperturbed position includes the growth of errors, and the
  /// effect of solvers that stop early. The result is three times that largest distance, so that other random
  /// directions stay below the bound: the maxima over hundreds of coordinates vary by less.
  struct Noise {
    std::vector<double> x, v;  // v is empty if the engine reports no velocities
    double start = 0;          // m, size of the perturbation
  };
  /// With contact, infinite from the first sample at which the perturbation has grown a millionfold. From there on,
  /// positions of single particles are unpredictable (round_off_bound() in experiments/metrics.h), and a perturbation
  /// may miss the event that separates two runs. `lengths` (m): the lengths that occur, if larger than in this run.
  Noise noise(const Scene& scene, double lengths = 0);
  /// The noise plus the effect of the residual that a stepper of mysim leaves in its implicit equation. Needed when the
  /// run is compared with a formula, or with a run whose residual is different or zero. In each step, the velocity
  /// error is the larger of two: (1) The solver stops at a fraction e of the largest force. Inertia m v / h is one of
  /// the forces, so the velocity of the lightest particle is off by up to e v m_max / m_min, no matter how short the
  /// step is. (2) The solver stops at the rounding error of the spring forces, 8 eps L sum k. The sum of the
  /// stiffnesses at a particle is at most 3 m omega^2, so the velocity is off by 24 eps omega^2 L h. Neither error
  /// changes its sign: after n steps the velocity error is n times as large, and positions are off by that velocity
  /// times the duration.
  Noise noise_with_unsolved(const Scene& scene, double lengths = 0);
  /// The noise without growth, m. `projected`: positions are projected onto constraints, which discards the previous
  /// positions. In that case, the velocity is off by u L / h in each step, which adds up to u L n sqrt(n). This holds
  /// for position-based rules and for contacts: rounding decides on which side of a surface a resting particle lies,
  /// and perturbations of the start do not reveal this.
  double rounding(double lengths, long steps, bool projected) const;

  /// Error of a position-based solver's iterations up to each sample, m; nullopt if the engine has no option n=. Such a
  /// solver processes particles and links one after the other, so that its unconverged result depends on their order.
  /// The error of n iterations falls as 1 / (n + a). The first iteration removes at least half of the error, which
  /// means a <= 1. Hence the error is at most 2 + 1 / n times the distance between the results of n and 2n iterations.
  std::optional<std::vector<double>> iteration_error(const Scene& scene);
  /// The engine with its number of iterations multiplied by `times`; nullopt if the engine has no option n=.
  std::optional<Method> with_iterations(int times) const;

 private:
  static constexpr double most_growth = 1e6;

  Method method_;
  std::map<std::string, SubjectRun> runs_;
  std::optional<bool> single_;      // as read back
  std::shared_ptr<Subject> twice_;  // this engine with twice the number of iterations
};

/// Largest coordinate vector of a run plus the size of its scene (m), which is the scale of rounding errors.
double lengths_in(const Scene& scene, const Trajectory& path);

}  // namespace crosscheck
