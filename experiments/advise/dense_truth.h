// The reference solution of a scene at any time, and the error of a run at all times, not only at the samples.
#pragma once

#include <optional>

#include "mysim/run/observers.h"
#include "reference/method.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Angular frequency of the fastest vibration in the scene, rad/s, among its springs at the start, the prescribed
/// motion of pins and spheres, and gusts. 0 if nothing vibrates.
double fastest_motion(const Scene& scene);

/// The truth at any time up to the end of the guarantee. A closed form is evaluated directly. Converged truth is
/// sampled at least eight times per period of the fastest motion. Between two samples, it is interpolated by cubics,
/// except across impacts. The number of samples is doubled until the interpolation error, estimated by leaving out
/// every other sample, is below a thirtieth of `tolerance` (m).
class DenseTruth {
 public:
  /// Throws CannotGuarantee if no truth is known, or if it would need too many samples.
  DenseTruth(const Scene& scene, double tolerance);

  const Truth& truth() const { return truth_; }
  /// The scene, sampled at the times of the dense truth.
  const Scene& dense() const { return dense_; }
  double until() const { return until_; }    // s
  double error_bar() const { return bar_; }  // m, error bar of the truth, including the interpolation error
  double motion() const { return motion_; }  // m, largest RMS distance from the start
  /// Time in which the phase of the fastest motion advances by a sixteenth of a radian, s. If an error is observed at
  /// this interval, the largest observed value is within 0.2 % of the maximum.
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
  std::vector<char> impact_;  // true if any particle hits a sphere between a sample and the next
  double until_ = 0, bar_ = 0, motion_ = 0, time_resolution_ = 0;
};

/// The scene's own run. For an adaptive method, run.step becomes at most the time resolution of the truth: it is only
/// the interval of observation, and does not affect the method's own steps. In scenes with contact, run.step would
/// limit those steps, so the run stays unchanged.
Run observed_run(const Method& method, const Scene& scene, const DenseTruth& path);

/// Keeps the largest RMS distance of a run from the truth. Skips a step if less than the truth's time resolution has
/// passed since the last observed step, but never skips a sample.
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
