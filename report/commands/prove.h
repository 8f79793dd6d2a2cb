// The builds of Crosscheck in which nothing may be found to have moved, as nothing has but the rounding.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

/// One row of the table in prove.cpp.
struct Build {
  std::string name;
  std::string compiler, package;  // Debian's package; both empty: the program as it is, in another environment
  std::string type, flags;        // as CMake has them
  std::string environment;        // NAME=value, or empty
  std::string filter = {};        // what it is asked where nobody says; empty: all
  bool fused = false;             // needs a processor with AVX2 and fused multiply-adds
  bool compiled() const { return !compiler.empty(); }
};
const std::vector<Build>& builds();

/// "clang++ (package clang)"; empty where nothing is missing.
std::string missing_for(const Build& build);

struct Built {
  std::filesystem::path program;
  std::string said;  // the last lines of a build that failed; empty where it went well
};
/// Configures and builds the program, and the engine that it starts, in build/builds/NAME of the source tree.
Built built(const Build& build);

}  // namespace crosscheck
