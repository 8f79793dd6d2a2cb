// The spring term for any spring graph: vectorised where that pays, otherwise through the plain loop.
#pragma once

#include <memory>

#include "mysim/terms/springs.h"

namespace crosscheck {

namespace simd {
enum class InstructionSet;
}

/// Adds the same forces as the plain edge loop of terms/springs.h, in another order. Each spring uses the cheapest of
/// three ways (simd/spring_graph/spring_layout.h): by its offset (DIA), in a list of edges (COO; both in
/// simd/spring_graph/dia_coo_kernels.h), or, if there are too few springs for lanes, through the plain loop itself. Its
/// force is the same to the last bit in each way. Results do not depend on threads, and all instruction sets give the
/// same bits.
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
  /// The instruction set that the kernels are compiled for.
  simd::InstructionSet isa() const { return isa_; }

 private:
  void add_on_lanes(const Points& x, Forces& forces);

  struct Impl;
  std::unique_ptr<Impl> impl_;  // null if the plain loop processes all springs
  Springs plain_;               // springs processed by the plain loop
  simd::InstructionSet isa_;
};

}  // namespace crosscheck
