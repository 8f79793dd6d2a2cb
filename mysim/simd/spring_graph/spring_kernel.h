// The spring term for any spring graph, fast: on lanes where that is worth it, else through the plain loop.
#pragma once

#include <memory>

#include "mysim/terms/springs.h"

namespace crosscheck {

namespace simd {
enum class InstructionSet;
}

/// Adds the same forces as the plain edge loop of terms/springs.h, in another order. Each spring goes the cheapest of
/// three ways (simd/spring_graph/plan.h): on a diagonal (simd/spring_graph/kernels.h), in a pair
/// (simd/spring_graph/kernels.h), or, where there are too few for lanes, through the plain loop itself. On all of them
/// its force is the same to the last bit. Nothing depends on threads; AVX2 and AVX-512 sort springs alike and give the
/// same bits.
class SpringKernel {
 public:
  /// For springs between `particles` particles. The springs' law must be Hooke's or Bullet's link law.
  SpringKernel(const Springs& springs, int particles);
  SpringKernel(SpringKernel&&) noexcept;
  ~SpringKernel();
  void add_force(const Points& x, Forces& forces);
  /// The instruction set that its lanes are compiled for.
  simd::InstructionSet isa() const { return isa_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;  // none where no spring is worth it
  Springs plain_;               // those that the plain loop is for
  simd::InstructionSet isa_;
};

}  // namespace crosscheck
