// Selects the instruction set of the kernels, at first use.
#pragma once

#include <string_view>
#include <vector>

namespace crosscheck::simd {

/// `baseline` has two doubles per register and fuses nothing; it runs on every machine (SSE2, NEON, WebAssembly).
enum class InstructionSet { baseline, avx2, avx512 };
std::string_view name_of(InstructionSet isa);

template <class Function>
Function select(InstructionSet isa, Function baseline, Function avx2, Function avx512) {
  return isa == InstructionSet::avx512 ? avx512 : isa == InstructionSet::avx2 ? avx2 : baseline;
}

/// Declares functions that a file compiled once per instruction set defines in `namespace CROSSCHECK_ISA`;
/// SELECT_COMPILED selects the version of `isa`.
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
#else  // ARM64 and WebAssembly
#define SELECT_COMPILED(isa, name) (static_cast<void>(isa), &baseline::name)
#endif

/// Instruction sets of this machine, best last.
std::vector<InstructionSet> supported_instruction_sets();

/// The best supported instruction set, or the one named by CROSSCHECK_INSTRUCTIONS (baseline, avx2, avx512). Throws
/// InputError if the name is unknown or the machine lacks it.
InstructionSet active_instruction_set();

}  // namespace crosscheck::simd
