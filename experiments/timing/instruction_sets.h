// Keeps mysim to one instruction set for a while; the sets in which it is timed against others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

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

/// The instruction sets in which mysim is timed against others: the machine's best (or the one that
/// CROSSCHECK_INSTRUCTIONS names), and the one that builds for every machine use, as the distribution's libraries do.
std::vector<simd::InstructionSet> compared_instruction_sets();

}  // namespace crosscheck
