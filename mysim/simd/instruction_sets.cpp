#include "mysim/simd/instruction_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "mysim/base/errors.h"

namespace crosscheck::simd {

std::string_view name_of(InstructionSet isa) {
  constexpr std::string_view names[] = {"baseline", "avx2", "avx512"};
  return names[static_cast<int>(isa)];
}

std::vector<InstructionSet> supported_instruction_sets() {
  std::vector<InstructionSet> all{InstructionSet::baseline};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(InstructionSet::avx2);
  if (all.size() > 1 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    all.push_back(InstructionSet::avx512);
#endif
  return all;
}

InstructionSet active_instruction_set() {
  const std::vector<InstructionSet> all = supported_instruction_sets();
  const char* named = std::getenv("CROSSCHECK_INSTRUCTIONS");
  if (!named || !*named) return all.back();
  for (const InstructionSet isa : all)
    if (name_of(isa) == named) return isa;
  throw InputError(fmt::format(
      "CROSSCHECK_INSTRUCTIONS={}: expected baseline, avx2 or avx512, as far as this machine supports them", named));
}

}  // namespace crosscheck::simd
