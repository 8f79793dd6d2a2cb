// The last moments of a run, as close together as its fastest vibration asks.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>

#include "mysim/observers/trajectory.h"

namespace crosscheck {

/// Keeps the last 25 pictures of a run whatever its length: eight to a period of the vibration omega (rad/s), or every
/// step where steps are longer than that, or nothing vibrates. So nothing that is shown looks slower than it was.
class LastPictures : public Observer {
 public:
  LastPictures(double omega, double h)
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

}  // namespace crosscheck
