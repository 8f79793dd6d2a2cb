// Springs go the ways that network/plan.h sorts them into.
#include "mysim/spring_kernel.h"

#include <optional>

#include "mysim/network/plan.h"

namespace crosscheck {

struct SpringKernel::Lanes {
  network::Functions run;
  std::optional<network::DiagonalMemory> diagonals;
  std::optional<network::PairMemory> pairs;
};

SpringKernel::SpringKernel(const Springs& springs, int particles) {
  const strip::Isa isa = strip::chosen();
  const SpringLaw law = springs.law;
  network::Plan plan = network::plan_for(springs.list, particles, network::costs(isa));
  plain_ = {std::move(plan.plain), law};
  if (plan.diagonals.empty() && plan.pairs.empty()) return;
  lanes_ = std::make_unique<Lanes>(Lanes{network::functions(isa, law), {}, {}});
  if (!plan.diagonals.empty()) lanes_->diagonals.emplace(plan.diagonals, particles);
  if (!plan.pairs.empty()) lanes_->pairs.emplace(plan.pairs, particles);
}

SpringKernel::SpringKernel(SpringKernel&&) noexcept = default;
SpringKernel::~SpringKernel() = default;

void SpringKernel::add_force(const Points& x, Forces& forces) {
  if (lanes_) {
    auto& [run, diagonals, pairs] = *lanes_;
    if (diagonals && run.diagonals(diagonals->view(), x.data(), forces.f.data())) forces.coincident += diagonals->met();
    if (pairs && run.pairs(pairs->view(), x.data(), forces.f.data())) forces.coincident += pairs->met();
  }
  crosscheck::add_force(plain_, x, forces);
}

}  // namespace crosscheck
