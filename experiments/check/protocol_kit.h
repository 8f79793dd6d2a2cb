// Conformance kit of the engine protocol: runs a program on small scenes and reports which parts of the protocol are
// missing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

enum class Conformance {
  ok,       // conforms to PROTOCOL.md
  lacks,    // missing so far
  refuses,  // exit status 3: the ingredient is not supported
};
std::string_view name_of(Conformance state);

struct ConformanceLine {
  std::string scene;  // empty: all scenes
  std::string topic;  // "sample times"
  Conformance state;
  bool required;        // false: optional, but results are more informative with it
  std::string told;     // observation, and advice if something is missing
  std::string section;  // section of PROTOCOL.md, if something is missing
};

struct ConformanceReport {
  std::string program;
  std::vector<ConformanceLine> lines;
  bool complete() const;  // true if no required part is missing
};

/// Runs the program twice on each of eight scenes of one and two particles, and on three scene files as a later version
/// or a careless caller might write them. Throws InputError if there is no such program.
ConformanceReport try_adapter(const std::string& program);

}  // namespace crosscheck
