#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

/// Restricts mysim's fast paths to an instruction set during its lifetime, as the variable CROSSCHECK_INSTRUCTIONS does
/// for a whole process. Not thread-safe.
class ScopedInstructionSet {
 public:
  explicit ScopedInstructionSet(simd::InstructionSet isa);
  ~ScopedInstructionSet();
  ScopedInstructionSet(const ScopedInstructionSet&) = delete;
  ScopedInstructionSet& operator=(const ScopedInstructionSet&) = delete;

 private:
  std::optional<std::string> before_;
};

/// The instruction sets in which mysim is timed: the machine's best one (or that of CROSSCHECK_INSTRUCTIONS), and the
/// baseline, which the distribution's libraries use because they must run on every machine.
std::vector<simd::InstructionSet> compared_instruction_sets();

}  // namespace crosscheck
