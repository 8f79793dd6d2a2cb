// Observers that experiments add to runs: the last frames of a run, and a limit on CPU time.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <deque>

#include "mysim/run/observers.h"
#include "mysim/run/run.h"

namespace crosscheck {

/// Keeps the last 25 frames of a run: eight per period of the vibration omega (rad/s), or every step if steps are
/// longer than that or nothing vibrates. Thus no motion appears to be slower than it was.
class LastFrames : public Observer {
 public:
  LastFrames(double omega, double h)
      : every_(omega * h > 0 ? std::max(1L, std::lround(2 * M_PI / (8 * omega * h))) : 1) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    if (seen_++ % every_ != 0 || !state.x.allFinite()) return Verdict::ok;
    kept_.push_back(state);
    if (kept_.size() > 25) kept_.pop_front();
    return Verdict::ok;
  }
  Trajectory path() const {
    Trajectory path;
    for (const State& s : kept_) path.t.push_back(s.t), path.x.push_back(s.x), path.v.push_back(s.v);
    return path;
  }

 private:
  long every_, seen_ = 0;
  std::deque<State> kept_;
};

/// Ends a run that takes too long: in an exploding motion, an adaptive rule takes ever shorter steps.
class TimeoutObserver : public Observer {
 public:
  explicit TimeoutObserver(double seconds)
      : until_(std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC)) {}
  bool every_step() const override { return true; }
  Verdict observe(const State&, bool) override { return std::clock() > until_ ? Verdict::timeout : Verdict::ok; }

 private:
  std::clock_t until_;
};

}  // namespace crosscheck
