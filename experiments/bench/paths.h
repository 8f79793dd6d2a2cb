// The two ways in which mysim is timed beside others.
#pragma once

#include <string>
#include <vector>

#include "mysim/strip/kernels.h"

namespace crosscheck {

struct Path {
  std::string name;
  strip::Isa instructions;
};

/// With the best instructions that the machine has (or those that CROSSCHECK_INSTRUCTIONS names); and with those alone
/// that builds for every machine use, as the distribution's libraries are built.
inline std::vector<Path> paths() { return {{"best", strip::chosen()}, {"sse2", strip::Isa::sse2}}; }

}  // namespace crosscheck
