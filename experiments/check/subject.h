// An engine that relations are asked of: its runs, each made once, and how far rounding alone may drive two of them
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

/// The relation says nothing about the engine. what() is the reason, one sentence without a full stop.
struct CannotBeAsked : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A run that a relation needs ended before its time. what() is how.
struct RunFailed : std::runtime_error {
  RunFailed(const std::string& how, double at, Verdict what) : std::runtime_error(how), end(at), verdict(what) {}
  double end;  // s
  Verdict verdict;
};

struct SubjectRun {
  Outcome outcome;
  Trajectory path;
};

/// The scene's own step, duration and samples; adaptive rules keep to 1e-9, since what they leave is no rounding.
Run run_for_relations(const Scene& scene);

class Subject {
 public:
  explicit Subject(Method method) : method_(std::move(method)) {}
  const Method& method() const { return method_; }

  /// A run, made once. Throws CannotBeAsked where the engine refuses the scene, and RunFailed.
  const SubjectRun& run(const Scene& scene, const Run& run);
  const SubjectRun& run(const Scene& scene) { return this->run(scene, run_for_relations(scene)); }
  /// The same, made now.
  SubjectRun fresh_run(const Scene& scene, const Run& run);

  /// Half the distance of 1 from the next number, in the precision that the engine says it has: its family's, or its
  /// read-back's. What says nothing is taken to compute in double precision.
  double unit_roundoff() const;

  /// How far two runs may be apart by rounding, m (and m/s), up to each sample. Every step rounds places to a unit
  /// round-off of the lengths that occur, in about ten operations, and the roundings of n steps add up like a random
  /// walk: 10 u L sqrt(n). (An adaptive rule leaves its tolerance in each of its steps instead.) The free particles
  /// start that far off in three seeded directions, and the farthest that a particle comes to be from its unperturbed
  /// self is measured, on this scene and by this engine: growth and solvers that stop early are in it. Three times
  /// that, since one more draw is to stay below: among the largest of hundreds of coordinates draws differ by less.
  struct Noise {
    std::vector<double> x, v;  // v is empty without velocities
    double start = 0;          // m, by which the perturbed runs were moved
  };
  /// Where there is contact, it is infinite from where it has grown a million-fold: there single positions cannot be
  /// predicted (experiments/metrics.h, round_off_bound), and a perturbation may or may not meet what parts two runs.
  /// `lengths` (m): the lengths that occur, where they are larger than in this run.
  Noise noise(const Scene& scene, double lengths = 0);
  /// The same, with what a rule of mysim's leaves of the equation in its step: for relations that hold a run against
  /// something that leaves it not, or otherwise. It stops at a part e of the largest force, of which inertia m v / h is
  /// one, so that the lightest particle's velocity is off by up to e v m_max / m_min in each step, however short, or at
  /// the rounding of the spring forces, 8 eps L sum k, where the stiffnesses at a particle are at most 3 m omega^2, so
  /// that the velocity is off by 24 eps omega^2 L h; and always to the same side: n of that after n steps, and places
  /// by that speed over the duration.
  Noise noise_with_unsolved(const Scene& scene, double lengths = 0);
  /// The part of it that is no growth, m. `projected`: places are put where they must be, and what was there before
  /// does not come back: the velocity that is left is off by u L / h in each step, which adds up to u L n sqrt(n). So
  /// do position-based rules, and so do contacts: on which side of a surface a particle lies that rests there is a
  /// matter of rounding, and no perturbation of the start shows it.
  double rounding(double lengths, long steps, bool projected) const;

  /// Position-based solvers go through particles and links one after the other: another order is another unconverged
  /// answer. The error of n of them falls as 1 / (n + a), of which a first one that takes half of it or more makes a at
  /// most 1: so it is at most 2 + 1 / n times the distance of n and 2n iterations: that for each sample, m; nothing
  /// where the engine has no option n=.
  std::optional<std::vector<double>> iteration_error(const Scene& scene);
  /// The same engine with so many times the iterations; nothing without an option n=.
  std::optional<Method> with_iterations(int times) const;

 private:
  static constexpr double most_growth = 1e6;

  Method method_;
  std::map<std::string, SubjectRun> runs_;
  std::optional<bool> single_;      // as read back
  std::shared_ptr<Subject> twice_;  // with twice the iterations
};

/// The largest coordinate vector of a run and the size of its scene, m: the lengths that are rounded.
double lengths_in(const Scene& scene, const Trajectory& path);

}  // namespace crosscheck
