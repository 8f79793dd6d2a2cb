#pragma once

#include <optional>
#include <string>

#include "reference/parameters/parameters.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Distance of the translated run from the original scene's solution. It is a difference, not an error, if that
/// solution comes from mysim's own contact rule or from another engine.
struct TranslatedRun {
  std::string method;
  Outcome outcome = {};                   // also states where the engine's laws differ from the scene's
  std::optional<double> error = {};       // m, largest RMS distance of the particles from the truth up to `until`
  std::optional<double> difference = {};  // m, replaces `error` if only an engine can serve as the reference
  std::string beside = {};                // name and tier of the reference
  std::optional<double> bar = {};         // m, error bar of the truth
  double motion = 0;                      // m, largest RMS distance from the start
  double until = 0;                       // s
};

/// Runs the translated scene with `method` at the translation's step. Compares it with the source's truth or, if there
/// is none, with mysim/symplectic-euler on the source at the same step.
TranslatedRun run_translated(const Scene& source, const Translation& translation, const Method& method);

}  // namespace crosscheck
