// Whole runs on a sheet and how far each ends from the truth: the errors that are compared.
#pragma once

#include "mysim/progress.h"
#include "reference/method.h"

namespace crosscheck {

/// Somebody to be compared with, and at which settings: tolerances of those that follow one, else steps in units of
/// leapfrog's largest stable one, 2 / omega with the scene's fastest vibration omega.
struct Peer {
  std::string method;
  std::vector<double> settings;
  bool other_model = false;  // what it converges to is something else than the scene's springs
};

/// A whole run, and where it ended.
struct SheetRun {
  Method method;
  Run run;
  Outcome outcome;
  double asked;                 // step in s, or tolerance
  std::optional<double> error;  // RMS over the particles at the end, m; of runs that ended well
  bool other_model = false;
  bool ok() const { return error.has_value(); }
};

class SheetRuns {
 public:
  /// Finds the truth: mysim/suzuki4 at a sixteenth of its largest step.
  SheetRuns(const Scene& scene, Progress& progress);
  /// What halving the truth's step changed at last, m.
  double bar() const { return bar_; }

  std::vector<SheetRun> of(const std::vector<Peer>& peers) const;
  /// mysim's, of each method from long steps to short ones: until a run errs no more than `wanted` (m), takes more
  /// evaluations than `most`, or more than a run of another method that errs less. In single precision where the sheet
  /// is wide enough for it.
  std::vector<SheetRun> own(double wanted, long most) const;

  /// How many are announced, the truth's and mysim's own among them.
  static int count(const std::vector<Peer>& peers);

 private:
  SheetRun done(const Method& method, double setting) const;
  Points end_of(double part) const;

  const Scene& scene_;
  Progress& progress_;
  double unit_;  // s: 2 / omega
  Points truth_;
  double bar_;
};

}  // namespace crosscheck
