#include "mysim/simd/spring_graph/spring_kernel.h"

#include <cassert>
#include <optional>

#include "mysim/simd/spring_graph/spring_layout.h"

namespace crosscheck {

struct SpringKernel::Impl {
  spring_graph::Kernels kernels;
  std::optional<spring_graph::DiaStorage> dia;
  std::optional<spring_graph::CooStorage> coo;
};

SpringKernel::SpringKernel(const Springs& springs, int particles) {
  const simd::InstructionSet isa = isa_ = simd::active_instruction_set();
  const SpringLaw law = springs.law;
  spring_graph::SpringPartition partition = spring_graph::partition_springs(springs.list, particles, {});
  plain_ = {std::move(partition.plain), law};
  if (partition.dia.empty() && partition.coo.empty()) return;
  impl_ = std::make_unique<Impl>(Impl{spring_graph::kernels(isa, law), {}, {}});
  if (!partition.dia.empty()) impl_->dia.emplace(partition.dia, particles);
  if (!partition.coo.empty()) impl_->coo.emplace(partition.coo, particles);
}

SpringKernel::SpringKernel(SpringKernel&&) noexcept = default;
SpringKernel::~SpringKernel() = default;

void SpringKernel::add_on_lanes(const Points& x, Forces& forces) {
  assert(x.cols() == forces.f.cols());
  auto& [kernels, dia, coo] = *impl_;
  if (dia && kernels.dia(dia->view(), x.data(), forces.f.data()))
    forces.degenerate_springs += dia->degenerate_springs();
  if (coo && kernels.coo(coo->view(), x.data(), forces.f.data()))
    forces.degenerate_springs += coo->degenerate_springs();
}

}  // namespace crosscheck
