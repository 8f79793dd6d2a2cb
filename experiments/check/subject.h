// The engine under test: its runs, each computed once, and the distance to which rounding alone may drive two of them
// apart.
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

/// The relation does not apply to the engine. what() is the reason, one sentence without a full stop.
struct CannotBeAsked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A run that a relation needs ended early. what() describes the failure.
struct RunFailed : std::runtime_error {
  RunFailed(const std::string& how, double at, Verdict what) : std::runtime_error(how), end(at), verdict(what) {}
  double end;  // s
  Verdict verdict;
};

struct SubjectRun {
  Outcome outcome;
  Trajectory path;
};

/// The scene's own step, duration and samples; adaptive rules use a tolerance of 1e-9, because their error is no
/// rounding.
Run run_for_relations(const Scene& scene);

class Subject {
 public:
  explicit Subject(Method method) : method_(std::move(method)) {}
  const Method& method() const { return method_; }

  /// A run, computed once. Throws CannotBeAsked if the engine refuses the scene, and RunFailed.
  const SubjectRun& run(const Scene& scene, const Run& run);
  const SubjectRun& run(const Scene& scene) { return this->run(scene, run_for_relations(scene)); }
  /// A run that is always computed again.
  SubjectRun fresh_run(const Scene& scene, const Run& run);

  /// Half the distance from 1 to the next number in the engine's precision, as its family declares it or its read-back
  /// reports it. Defaults to double precision.
  double unit_roundoff() const;

  /// Distance to which rounding may drive two runs apart, m (and m/s), up to each sample. Every step rounds positions
  /// to a unit round-off of the lengths that occur, in about ten operations, and the roundings of n steps accumulate
  /// like a random walk: 10 u L sqrt(n). (The error of an adaptive rule is its tolerance per step instead.) Perturbs
  /// the free particles by that distance in two seeded directions, with both signs, and measures the largest resulting
  /// distance of a particle from its unperturbed position on this scene by this engine, which includes growth and
  /// solvers that stop early. The result is three times that, so that one more random direction stays below: the maxima
  /// over hundreds of coordinates vary by less.
  struct Noise {
    std::vector<double> x, v;  // v is empty without velocities
    double start = 0;          // m, size of the perturbation
  };
  /// With contact, it is infinite from the sample at which it has grown a million-fold: single positions cannot be
  /// predicted then (experiments/metrics.h, round_off_bound), and a perturbation may or may not reach the event that
  /// separates two runs. `lengths` (m): the lengths that occur, if they are larger than in this run.
  Noise noise(const Scene& scene, double lengths = 0);
  /// The noise, including the residual that a stepper of mysim leaves in its implicit equation: for relations that
  /// compare with something that has no residual or a different one. The solver stops at a fraction e of the largest
  /// force. Inertia m v / h is one of the forces, so that the velocity of the lightest particle is off by up to e v
  /// m_max / m_min in each step, however short. Or it stops at the rounding of the spring forces, 8 eps L sum k; the
  /// sum of the stiffnesses at a particle is at most 3 m omega^2, so that the velocity is off by 24 eps omega^2 L h.
  /// Both errors always have the same sign: after n steps the velocity is off by n times as much, and positions by that
  /// speed times the duration.
  Noise noise_with_unsolved(const Scene& scene, double lengths = 0);
  /// The part of the noise that is not growth, m. `projected`: positions are projected onto constraints, which loses
  /// the previous positions: the remaining velocity is off by u L / h in each step, which adds up to u L n sqrt(n).
  /// This holds for position-based rules, and for contacts: rounding decides on which side of a surface a resting
  /// particle lies, and no perturbation of the start reveals that.
  double rounding(double lengths, long steps, bool projected) const;

  /// Error of a position-based solver's iterations up to each sample, m; nothing if the engine has no option n=. Such a
  /// solver processes particles and links one after the other, so that another order gives another unconverged result.
  /// The error of n iterations falls as 1 / (n + a). The first iteration removes half of the error or more, which means
  /// a <= 1. Hence the error is at most 2 + 1 / n times the distance between the results of n and 2n iterations.
  std::optional<std::vector<double>> iteration_error(const Scene& scene);
  /// The engine with `times` as many iterations; nothing if it has no option n=.
  std::optional<Method> with_iterations(int times) const;

 private:
  static constexpr double most_growth = 1e6;

  Method method_;
  std::map<std::string, SubjectRun> runs_;
  std::optional<bool> single_;      // single precision, as read back
  std::shared_ptr<Subject> twice_;  // with twice the iterations
};

/// Largest coordinate vector of a run plus the size of its scene, m: the scale of rounding errors.
double lengths_in(const Scene& scene, const Trajectory& path);

}  // namespace crosscheck
