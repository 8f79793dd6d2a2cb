// Runs that nobody stops.
#pragma once

#include <utility>

#include "mysim/engine.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

/// The first step at which a run that nobody stops is more than ten times as fast as `speed`, by central differences.
inline long step_of_leaving(const Scene& scene, const crosscheck::Run& run, const char* rule, double speed) {
  struct Free : Observer {
    explicit Free(double fastest) : most(fastest) {}
    bool every_step() const override { return true; }
    Verdict observe(const State& s, bool) override {
      ++step;
      if (left == 0 && step >= 2 && largest_column(s.x - before.x) / (s.t - before.t) > most) left = step;
      before = std::exchange(last, s);
      return Verdict::ok;
    }
    double most;
    State before, last;
    long step = -1, left = 0;
  } free(10 * speed);
  simulate(stepper(rule), ContactRule::coulomb, scene, run, free);
  return free.left;
}

}  // namespace crosscheck::testing_tools
