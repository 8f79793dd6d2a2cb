// The conformance kit of the engine protocol: runs a program on small scenes and reports the missing parts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

enum class Conformance {
  ok,       // conforms to PROTOCOL.md
  lacks,    // missing so far
  refuses,  // the program reports by exit status 3 that it does not support the ingredient
};
std::string_view name_of(Conformance state);

struct ConformanceLine {
  std::string scene;  // empty: applies to all scenes
  std::string topic;  // "sample times"
  Conformance state;
  bool required;        // without it the program is no adapter; optional parts make results more informative
  std::string told;     // the observation, and advice if something is missing
  std::string section;  // section of PROTOCOL.md, if something is missing; else empty
};

struct ConformanceReport {
  std::string program;
  std::vector<ConformanceLine> lines;
  bool complete() const;  // no required part is missing
};

/// Runs the program on eight scenes of one and two particles, twice each, and on three that are changed as a later
/// version or a careless caller might do. Throws InputError if there is no such program.
ConformanceReport try_adapter(const std::string& program);

}  // namespace crosscheck
