// The instruction set that the kernels run on, chosen at its first use.
#pragma once

#include <string_view>
#include <vector>

namespace crosscheck::simd {

enum class InstructionSet { sse2, avx2, avx512 };
std::string_view name_of(InstructionSet isa);

template <class Function>
Function select(InstructionSet isa, Function sse2, Function avx2, Function avx512) {
  return isa == InstructionSet::avx512 ? avx512 : isa == InstructionSet::avx2 ? avx2 : sse2;
}

/// Declares functions that a file compiled once for each instruction set defines in `namespace CROSSCHECK_ISA`; and
/// that one of them which is compiled for `isa`.
#define COMPILED_FOR_EACH_INSTRUCTION_SET(...) \
  namespace sse2 {                             \
  __VA_ARGS__;                                 \
  }                                            \
  namespace avx2 {                             \
  __VA_ARGS__;                                 \
  }                                            \
  namespace avx512 {                           \
  __VA_ARGS__;                                 \
  }
#ifdef __x86_64__
#define SELECT_COMPILED(isa, name) ::crosscheck::simd::select(isa, &sse2::name, &avx2::name, &avx512::name)
#else  // one set alone: two doubles side by side, the same bits as with SSE2
#define SELECT_COMPILED(isa, name) (&sse2::name)
#endif

/// The instruction sets of this machine, the best last.
std::vector<InstructionSet> supported_instruction_sets();

/// The best there is, or the one that CROSSCHECK_INSTRUCTIONS names (sse2, avx2, avx512). Throws InputError where it
/// names none of them or one that this machine lacks.
InstructionSet active_instruction_set();

}  // namespace crosscheck::simd
