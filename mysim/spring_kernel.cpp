// Springs go the ways that network/plan.h sorts them into.
#include "mysim/spring_kernel.h"

#include <optional>

#include "mysim/network/plan.h"

namespace crosscheck {

struct SpringKernel::Lanes {
  network::Functions run;
  std::optional<network::BandMemory> bands;
  std::optional<network::PairMemory> pairs;
};

SpringKernel::SpringKernel(const Springs& springs, int particles) {
  const strip::Isa isa = strip::chosen();
  const SpringLaw law = springs.law;
  network::Plan plan = network::plan_for(springs.list, particles, network::costs(isa));
  plain_ = {std::move(plan.plain), law};
  if (plan.bands.empty() && plan.pairs.empty()) return;
  lanes_ = std::make_unique<Lanes>(Lanes{network::functions(isa, law), {}, {}});
  if (!plan.bands.empty()) lanes_->bands.emplace(plan.bands, particles);
  if (!plan.pairs.empty()) lanes_->pairs.emplace(plan.pairs, particles);
}

SpringKernel::SpringKernel(SpringKernel&&) noexcept = default;
SpringKernel::~SpringKernel() = default;

void SpringKernel::add_force(const Points& x, Forces& forces) {
  if (lanes_) {
    auto& [run, bands, pairs] = *lanes_;
    if (bands && run.bands(bands->view(), x.data(), forces.f.data())) forces.coincident += bands->met();
    if (pairs && run.pairs(pairs->view(), x.data(), forces.f.data())) forces.coincident += pairs->met();
  }
  crosscheck::add_force(plain_, x, forces);
}

}  // namespace crosscheck
