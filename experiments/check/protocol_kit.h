// The conformance kit of the engine protocol: runs a program on the smallest scenes and says what it lacks still.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

enum class Conformance {
  ok,       // as PROTOCOL.md asks
  lacks,    // not yet
  refuses,  // the program says by exit status 3 that it has no such thing
};
std::string_view name_of(Conformance state);

struct ConformanceLine {
  std::string scene;  // empty: of all scenes
  std::string topic;  // "sample times"
  Conformance state;
  bool required;        // without it the program is no adapter; the rest makes results more telling
  std::string told;     // what was found, and what to do where it lacks
  std::string section;  // of PROTOCOL.md, where it lacks; else empty
};

struct ConformanceReport {
  std::string program;
  std::vector<ConformanceLine> lines;
  bool complete() const;  // nothing required lacks
};

/// Tries the program on eight scenes of one and two particles, twice each, and on three that are changed as a later
/// version or a careless caller would. Throws InputError when there is no such program.
ConformanceReport try_adapter(const std::string& program);

}  // namespace crosscheck
