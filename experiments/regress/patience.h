// Runs that must come to an end.
#pragma once

#include <ctime>

#include "mysim/run.h"

namespace crosscheck {

/// Ends a run that takes many times what it should: an adaptive rule in a motion that explodes takes ever shorter
/// steps.
class Patience : public Observer {
 public:
  explicit Patience(double seconds) : until_(std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC)) {}
  bool every_step() const override { return true; }
  Verdict observe(const State&, bool) override { return std::clock() > until_ ? Verdict::timeout : Verdict::ok; }

 private:
  std::clock_t until_;
};

}  // namespace crosscheck
