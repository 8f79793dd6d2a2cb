// Looking at a run by pairs of states two steps apart, without looking at every step.
#pragma once

#include "mysim/run.h"

namespace crosscheck {

/// An observer of samples that is also shown, by the run loop, the state two steps before each sample (where a sampling
/// interval has two steps or more), and such a pair every `steps_between_pairs` steps before it, whoever else looks at
/// every step. Where only samples are known (outside programs, adaptive rules) neither function is called.
class PairsObserver : public Observer {
 public:
  static constexpr int steps_between_pairs = 16;
  /// Once true it stays so: later() is then shown every state between two samples, and earlier() none.
  virtual bool closely() const { return false; }
  /// The state two steps before the next that is shown.
  virtual void earlier(const State& state) = 0;
  /// The state two steps after that one, or any where looking closely, between two samples. Anything but Verdict::ok
  /// ends the run.
  virtual Verdict later(const State& state) = 0;
};

}  // namespace crosscheck
