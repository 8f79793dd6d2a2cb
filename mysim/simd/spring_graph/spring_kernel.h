// The spring term for any spring graph, vectorised where that pays.
#pragma once

#include <memory>

#include "mysim/terms/springs.h"

namespace crosscheck {

namespace simd {
enum class InstructionSet;
}

/// Adds the forces of the plain edge loop of terms/springs.h, in another order. Each force is computed in the cheapest
/// of three ways (simd/spring_graph/spring_layout.h), with the same bits in each: by the offset of its spring (DIA), in
/// a list of edges (COO), or, if there are too few springs for lanes, by the plain loop. The first two are in
/// dia_coo_kernels.h. Results depend neither on threads nor on the instruction set.
class SpringKernel {
 public:
  /// The law must be Hooke's or Bullet's link law.
  SpringKernel(const Springs& springs, int particles);
  SpringKernel(SpringKernel&&) noexcept;
  ~SpringKernel();
  void add_force(const Points& x, Forces& forces) {
    if (impl_) add_on_lanes(x, forces);
    crosscheck::add_force(plain_, x, forces);
  }
  simd::InstructionSet isa() const { return isa_; }

 private:
  void add_on_lanes(const Points& x, Forces& forces);

  struct Impl;
  std::unique_ptr<Impl> impl_;  // null if all springs are plain
  Springs plain_;               // processed by the plain loop
  simd::InstructionSet isa_;
};

}  // namespace crosscheck
