// An adapter with deliberate defects, and the conformance kit's report about it.
#pragma once

#include <set>

#include "experiments/check/protocol_kit.h"
#include "tests/unit/temporary.h"

namespace crosscheck::testing_tools {

class ProtocolKit : public InFolder {
 protected:
  /// Runs the kit on the shipped example. A script around the example corrupts the scene or the answer.
  ConformanceReport spoiled(const std::string& before, const std::string& after = "") const {
    return try_adapter("exec:" + script("adapter", before + CROSSCHECK_EXAMPLE " \"$1\" \"$2\" || exit $?\n" + after));
  }
  static std::set<std::string> lacking(const ConformanceReport& report, bool required) {
    std::set<std::string> topics;
    for (const ConformanceLine& line : report.lines)
      if (line.state == Conformance::lacks && line.required == required) topics.insert(line.topic);
    return topics;
  }
};

}  // namespace crosscheck::testing_tools
