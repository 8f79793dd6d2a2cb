// Springs take the kernels that simd/spring_graph/plan.h sorts them into.
#include "mysim/simd/spring_graph/spring_kernel.h"

#include <cassert>
#include <optional>

#include "mysim/simd/spring_graph/plan.h"

namespace crosscheck {

struct SpringKernel::Impl {
  spring_graph::Kernels run;
  std::optional<spring_graph::DiaStorage> diagonals;
  std::optional<spring_graph::CooStorage> pairs;
};

SpringKernel::SpringKernel(const Springs& springs, int particles) {
  const simd::InstructionSet isa = isa_ = simd::active_instruction_set();
  const SpringLaw law = springs.law;
  spring_graph::SpringPartition partition =
      spring_graph::partition_springs(springs.list, particles, spring_graph::costs(isa));
  plain_ = {std::move(partition.plain), law};
  if (partition.diagonals.empty() && partition.pairs.empty()) return;
  impl_ = std::make_unique<Impl>(Impl{spring_graph::kernels(isa, law), {}, {}});
  if (!partition.diagonals.empty()) impl_->diagonals.emplace(partition.diagonals, particles);
  if (!partition.pairs.empty()) impl_->pairs.emplace(partition.pairs, particles);
}

SpringKernel::SpringKernel(SpringKernel&&) noexcept = default;
SpringKernel::~SpringKernel() = default;

void SpringKernel::add_force(const Points& x, Forces& forces) {
  assert(x.cols() == forces.f.cols());
  if (impl_) {
    auto& [run, diagonals, pairs] = *impl_;
    if (diagonals && run.diagonals(diagonals->view(), x.data(), forces.f.data()))
      forces.degenerate_springs += diagonals->degenerate_springs();
    if (pairs && run.pairs(pairs->view(), x.data(), forces.f.data()))
      forces.degenerate_springs += pairs->degenerate_springs();
  }
  crosscheck::add_force(plain_, x, forces);
}

}  // namespace crosscheck
