// Which instruction set the kernels run on, chosen when it is asked for.
#pragma once

#include <string_view>
#include <vector>

namespace crosscheck::simd {

enum class InstructionSet { sse2, avx2, avx512 };
std::string_view name_of(InstructionSet isa);

/// What this machine has, the best last.
std::vector<InstructionSet> supported_instruction_sets();

/// The best there is, or the one that CROSSCHECK_INSTRUCTIONS names (sse2, avx2, avx512). Throws InputError where it
/// names none of them or one that this machine lacks.
InstructionSet active_instruction_set();

}  // namespace crosscheck::simd
