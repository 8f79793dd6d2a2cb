// Keeps mysim to one instruction set for a while; the two sets in which it is timed against others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

// The instruction set that mysim uses, for a while.

/// For as long as it is there mysim's fast paths keep to an instruction set, as CROSSCHECK_INSTRUCTIONS does it from
/// outside; afterwards all is as before. Not for use while other threads run.
class ScopedInstructionSet {
 public:
  explicit ScopedInstructionSet(simd::InstructionSet isa);
  ~ScopedInstructionSet();
  ScopedInstructionSet(const ScopedInstructionSet&) = delete;
  ScopedInstructionSet& operator=(const ScopedInstructionSet&) = delete;

 private:
  std::optional<std::string> before_;
};

// The two instruction sets in which mysim is timed against others.

struct CodePath {
  std::string name;
  simd::InstructionSet instructions;
};

/// With the best instructions that the machine has (or those that CROSSCHECK_INSTRUCTIONS names); and with those alone
/// that builds for every machine use, as the distribution's libraries are built.
inline std::vector<CodePath> code_paths() {
  return {{"best", simd::active_instruction_set()}, {"baseline", simd::InstructionSet::baseline}};
}

}  // namespace crosscheck
