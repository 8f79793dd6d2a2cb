// The truth of a scene at any time, and how far a run comes from it: between the samples too.
#pragma once

#include <optional>

#include "mysim/run/observers.h"
#include "reference/method.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Angular frequency of the fastest vibration that can carry motion in the scene, rad/s: of its springs at the start,
/// of what leads its pins and spheres, of its gusts. 0 where nothing vibrates.
double fastest_motion(const Scene& scene);

/// The truth up to the end of what can be guaranteed, at any time. A closed form is evaluated at each time. Converged
/// truth is sampled eight times in each period of the fastest motion, or more often, and interpolated between samples
/// by cubics with the velocities at both ends, but not across impacts: samples are doubled until the interpolation
/// error, estimated by leaving out every other sample, is below a thirtieth of `tolerance` (m).
class DenseTruth {
 public:
  /// Throws CannotGuarantee where no truth is known, or the samples would be too many.
  DenseTruth(const Scene& scene, double tolerance);

  const Truth& truth() const { return truth_; }
  /// The scene with all these samples: what is measured in it sees the whole motion.
  const Scene& dense() const { return dense_; }
  double until() const { return until_; }    // s
  double error_bar() const { return bar_; }  // m, the truth's, with the interpolation error
  double motion() const { return motion_; }  // m, the largest RMS distance from the start
  /// s: within it the fastest motion turns by a sixteenth of a radian, and no error changes by more than 0.2 % of its
  /// largest.
  double time_resolution() const { return time_resolution_; }
  Points at(double t) const;  // m, 3 x n; t in s, up to until()

 private:
  void measure();
  Points free_path(int sample, double t) const;
  bool runs_in(double t, const Vec3& x, double t_end, const Vec3& end) const;
  Points interpolated(int from, int to, double t) const;
  double interpolation_error() const;

  Scene dense_;
  std::optional<ExactSolution> exact_;
  Truth truth_;
  std::vector<char> impact_;  // true if a particle hits a sphere between a sample and the next
  double until_ = 0, bar_ = 0, motion_ = 0, time_resolution_ = 0;
};

/// The scene's own run, observed at the truth's time resolution: a method that chooses its steps is observed on the
/// grid of the run's step, and takes the same steps whatever that is (beside a sphere it bounds them, and stays what it
/// was).
Run observed_run(const Method& method, const Scene& scene, const DenseTruth& path);

/// Observes every step of a run, and keeps the largest RMS distance from the truth. Steps closer to the one before than
/// the truth's time resolution are passed over, samples never.
class MaxErrorObserver : public Observer {
 public:
  explicit MaxErrorObserver(const DenseTruth& path) : path_(path) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override;
  double distance() const { return distance_; }  // m

 private:
  const DenseTruth& path_;
  double distance_ = 0, last_ = -INFINITY;
};

}  // namespace crosscheck
