#include "experiments/timing/instruction_sets.h"

#include <cstdlib>

namespace crosscheck {
namespace {

constexpr auto variable = "CROSSCHECK_INSTRUCTIONS";

}  // namespace

ScopedInstructionSet::ScopedInstructionSet(simd::InstructionSet isa) {
  if (const char* value = std::getenv(variable)) before_ = value;
  setenv(variable, std::string(simd::name_of(isa)).c_str(), 1);
}

ScopedInstructionSet::~ScopedInstructionSet() {
  if (before_)
    setenv(variable, before_->c_str(), 1);
  else
    unsetenv(variable);
}

std::vector<simd::InstructionSet> compared_instruction_sets() {
  const simd::InstructionSet best = simd::active_instruction_set(), baseline = simd::InstructionSet::baseline;
  return best == baseline ? std::vector{baseline} : std::vector{best, baseline};
}

}  // namespace crosscheck
