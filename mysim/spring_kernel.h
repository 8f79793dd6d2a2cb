// The spring term for any network, fast: each spring once, then a gather per particle; no scatter, no atomics.
#pragma once

#include <vector>

#include "mysim/terms/springs.h"

namespace crosscheck {

/// Adds the same forces as the plain edge loop of terms/springs.h, up to the order of summation. First a pass over the
/// springs, in blocks: end points are gathered, roots and quotients are taken side by side, and each spring's force is
/// written to its own place. Then a pass over the particles: each adds up its springs, in the order of the list.
/// Nothing depends on threads or on the instruction set: the same input gives the same bits.
class SpringKernel {
 public:
  /// For springs between `particles` particles. The springs' law must be Hooke's or Bullet's link law.
  SpringKernel(const Springs& springs, int particles);
  void add_force(const Points& x, Forces& forces);

 private:
  struct Ends {
    int a, b;
  };
  long spring_pass(const Points& x);

  SpringLaw law_;
  std::vector<Ends> ends_;
  std::vector<double> k_, rest_;  // one for each spring, padded to whole blocks
  Points force_;                  // N (3 x springs): on end a
  std::vector<int> first_;        // particles + 1: where each one's entries begin in the two lists below
  std::vector<int> spring_;       // which spring
  std::vector<double> sign_;      // +1 at its end a, -1 at its end b
};

}  // namespace crosscheck
