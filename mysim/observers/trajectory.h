// Samples of one run, and the observer that gathers them.
#pragma once

#include <vector>

#include "mysim/run.h"

namespace crosscheck {

struct Trajectory {
  std::vector<double> t;  // s
  std::vector<Points> x;  // frames of N (3 x n), m
  std::vector<Points> v;  // frames of N (3 x n), m/s; frames of 3 x 0 in first-order scenes
  int frames() const { return static_cast<int>(t.size()); }
};

class Recorder : public Observer {
 public:
  Verdict observe(const State& state, bool sample) override {
    if (sample) {
      trajectory.t.push_back(state.t);
      trajectory.x.push_back(state.x);
      trajectory.v.push_back(state.v);
    }
    return Verdict::ok;
  }
  Trajectory trajectory;
};

}  // namespace crosscheck
