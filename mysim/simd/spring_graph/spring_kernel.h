// The spring term for any spring graph, fast: on lanes where that is worth it, else through the plain loop.
#pragma once

#include <memory>

#include "mysim/terms/springs.h"

namespace crosscheck {

namespace simd {
enum class InstructionSet;
}

/// Adds the same forces as the plain edge loop of terms/springs.h, in another order. Each spring goes the cheapest of
/// three ways (simd/spring_graph/spring_layout.h): by its offset (DIA), in a list of edges (COO; both in
/// simd/spring_graph/dia_coo_kernels.h), or, where there are too few for lanes, through the plain loop itself. On all
/// of them its force is the same to the last bit. Nothing depends on threads, and all instruction sets give the same
/// bits.
class SpringKernel {
 public:
  /// For springs between `particles` particles. The springs' law must be Hooke's or Bullet's link law.
  SpringKernel(const Springs& springs, int particles);
  SpringKernel(SpringKernel&&) noexcept;
  ~SpringKernel();
  void add_force(const Points& x, Forces& forces) {
    if (impl_) add_on_lanes(x, forces);
    crosscheck::add_force(plain_, x, forces);
  }
  /// The instruction set that its lanes are compiled for.
  simd::InstructionSet isa() const { return isa_; }

 private:
  void add_on_lanes(const Points& x, Forces& forces);

  struct Impl;
  std::unique_ptr<Impl> impl_;  // null where the plain loop takes all springs
  Springs plain_;               // those that the plain loop takes
  simd::InstructionSet isa_;
};

}  // namespace crosscheck
