// mysim compared with Bullet and other integrators on a cloth: at the same error, and at the same step.
#pragma once

#include "experiments/experiment.h"
#include "experiments/timing/timing.h"
#include "mysim/base/progress.h"
#include "reference/method.h"

namespace crosscheck {

// Whole runs on a cloth and their errors at the end, which are compared.

/// A method to compare with, and its settings: tolerances of those that follow one, else steps in units of
/// leapfrog's largest stable one, 2 / omega with the scene's fastest vibration omega.
struct Peer {
  std::string method;
  std::vector<double> settings;
  bool other_model = false;  // what it converges to is something else than the scene's springs
};

/// A whole run, and where it ended.
struct PeerRun {
  Method method;
  Run run;
  Outcome outcome;
  double requested;             // step in s, or tolerance
  std::optional<double> error;  // RMS over the particles at the end, m; of runs that ended well
  bool other_model = false;
  bool ok() const { return error.has_value(); }
};

class PeerRuns {
 public:
  /// Finds the truth: mysim/suzuki4 at a sixteenth of its largest step.
  PeerRuns(const Scene& scene, Progress& progress);
  /// The change by the last halving of the truth's step, m.
  double error_bar() const { return bar_; }

  std::vector<PeerRun> of(const std::vector<Peer>& peers) const;
  /// mysim's, of each method from long steps to short ones: until a run errs no more than `wanted` (m), takes more
  /// evaluations than `most`, or more than a run of another method that errs less. In single precision where the cloth
  /// is wide enough for it.
  std::vector<PeerRun> own(double wanted, long most) const;

  /// The number of announced runs, the truth's and mysim's own among them.
  static int count(const std::vector<Peer>& peers);

 private:
  PeerRun done(const Method& method, double setting) const;
  Points end_of(double part) const;

  const Scene& scene_;
  Progress& progress_;
  double unit_;  // s: 2 / omega
  Points truth_;
  double bar_;
};

// The cost of the same accuracy: mysim, Bullet and other integrators, on a cloth.

struct EqualErrorOptions {
  std::shared_ptr<const Scene> scene;
  std::vector<Peer> peers;
  TimedRunOptions turns;
};

/// The number of announced steps of work.
int work_of(const EqualErrorOptions& options);

/// `bench-equal-error-cost`: for each run of each peer its error (peers.h), its time, and how many times that is
/// the time of mysim's cheapest run that errs no more (the truth's bar counted against mysim on both sides), round by
/// round: once with the best instructions that the machine has, once with the baseline. No ratio stands where the
/// peer's error is within the bar. `bench-own-runs-cost`: mysim's runs.
void equal_error(const EqualErrorOptions& options, const LockPatience& patience, TableSet& tables, Progress& progress);

// Bullet's explicit world and mysim's symplectic Euler at the same step: the same rule, so that the time of a step
// is all that differs.

struct SameStepOptions {
  int side = 64;          // particles along a side of the cloth
  double duration = 0.2;  // s, over which both are followed
  TimedRunOptions turns;
};

/// `bench-same-step-cost`: on a cloth whose three stiffnesses a force class of Crosscheck's carries in Bullet (without
/// faces), and on one of two stiffnesses under Bullet's own spring force: how far apart both engines are at the end
/// (the farthest particle, m), the time of a step, and the ratio of the times, round by round; with the best
/// instructions for mysim, and with the baseline.
void same_step(const SameStepOptions& options, const LockPatience& patience, TableSet& tables, Progress& progress);

}  // namespace crosscheck
