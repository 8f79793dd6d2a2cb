// The instruction set that the kernels run on, chosen at its first use.
#pragma once

#include <string_view>
#include <vector>

namespace crosscheck::simd {

/// The baseline is what every machine has: two doubles side by side, nothing fused (SSE2, NEON, WebAssembly).
enum class InstructionSet { baseline, avx2, avx512 };
std::string_view name_of(InstructionSet isa);

template <class Function>
Function select(InstructionSet isa, Function baseline, Function avx2, Function avx512) {
  return isa == InstructionSet::avx512 ? avx512 : isa == InstructionSet::avx2 ? avx2 : baseline;
}

/// Declares functions that a file compiled once for each instruction set defines in `namespace CROSSCHECK_ISA`; and
/// that one of them which is compiled for `isa`.
#define COMPILED_FOR_EACH_INSTRUCTION_SET(...) \
  namespace baseline {                         \
  __VA_ARGS__;                                 \
  }                                            \
  namespace avx2 {                             \
  __VA_ARGS__;                                 \
  }                                            \
  namespace avx512 {                           \
  __VA_ARGS__;                                 \
  }
#ifdef __x86_64__
#define SELECT_COMPILED(isa, name) ::crosscheck::simd::select(isa, &baseline::name, &avx2::name, &avx512::name)
#else  // ARM64 and WebAssembly have the baseline alone
#define SELECT_COMPILED(isa, name) (static_cast<void>(isa), &baseline::name)
#endif

/// The instruction sets of this machine, the best last.
std::vector<InstructionSet> supported_instruction_sets();

/// The best there is, or the one that CROSSCHECK_INSTRUCTIONS names (baseline, avx2, avx512). Throws InputError where
/// it names none of them or one that this machine lacks.
InstructionSet active_instruction_set();

}  // namespace crosscheck::simd
