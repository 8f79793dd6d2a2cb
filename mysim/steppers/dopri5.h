// The embedded pair of Dormand and Prince of orders 5(4), with its interpolant (J. R. Dormand and P. J. Prince,
// J. Comput. Appl. Math. 6, 1980; interpolant of order 4: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary
// Differential Equations I, II.6).
#pragma once

#include <array>

#include "mysim/system.h"

namespace crosscheck {

class DormandPrince {
 public:
  explicit DormandPrince(const State& like) : next_(like), stage_(like), k_{like, like, like, like, like, like, like} {}

  /// Tries a step of h from s: fills next() and the error estimate. Six evaluations; seven at the first step and after
  /// forget().
  void attempt(System& f, State& s, double h);
  const State& next() const { return next_; }
  /// Estimated error of next() in positions (3 x n, m) and velocities (3 x n, m/s): order 5 against order 4.
  const State& error();
  /// Largest speed that the first stage alone would give in the attempted step, m/s.
  double first_step_speed() const { return stage_.t * largest_column(k_[0].v); }
  /// The last stage of an accepted step is the first of the next one.
  void accept() { std::swap(k_[0], k_[6]); }
  /// The state was changed from outside: the first stage is evaluated again.
  void forget() { first_known_ = false; }
  /// The state at s.t + theta h, 0 <= theta <= 1, of the step last attempted from s and not yet accepted.
  void interpolate(const State& s, double h, double theta, State& out) const;

 private:
  State next_, stage_;
  std::array<State, 7> k_;
  bool first_known_ = false;
};

}  // namespace crosscheck
