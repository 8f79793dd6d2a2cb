// The spring term for any network, fast: each spring once, then a gather per particle; no scatter, no atomics.
#pragma once

#include <vector>

#include "mysim/terms/springs.h"

namespace crosscheck {

/// Adds the same forces as the plain edge loop of terms/springs.h, up to the order of summation. The springs are kept
/// in the order of their ends a. A first pass goes over them in blocks: ends are gathered, roots and quotients are
/// taken side by side, and each spring's force is written to its own place. A second pass goes over the particles: each
/// adds up the springs that begin at it, which lie side by side, and subtracts those that end at it. Nothing depends on
/// threads or on the instruction set: the same input gives the same bits.
class SpringKernel {
 public:
  /// For springs between `particles` particles. The springs' law must be Hooke's or Bullet's link law.
  SpringKernel(const Springs& springs, int particles);
  void add_force(const Points& x, Forces& forces);

 private:
  struct Ends {
    int a, b;
  };
  /// Four numbers a column, the last one 0: two machine words of the plainest instruction set, where three would be one
  /// and a half.
  using Columns = Eigen::Matrix4Xd;
  long spring_pass();

  SpringLaw law_;
  std::vector<Ends> ends_;
  std::vector<double> k_, rest_;  // one for each spring, padded to whole blocks
  Columns x_;                     // positions, m
  Columns force_;                 // N: of each spring on its end a
  std::vector<int> begin_at_;  // particles + 1: the springs whose end a is particle i are begin_at_[i] ... [i + 1] - 1
  std::vector<int> end_at_;    // particles + 1: likewise, the part of ending_ of those whose end b it is
  std::vector<int> ending_;
};

}  // namespace crosscheck
