#pragma once

#include <optional>
#include <string>

#include "reference/parameters/parameters.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Distance of the translated run from the original scene's solution. It is a difference, not an error, if the truth is
/// that of the in-house contact rule or another engine.
struct TranslatedRun {
  std::string method;
  Outcome outcome = {};                   // the verdict, and where the engine's laws differ from the scene's
  std::optional<double> error = {};       // m, largest RMS distance of the particles from the truth up to `until`
  std::optional<double> difference = {};  // m, that distance if there is no truth independent of engines
  std::string beside = {};                // the reference and its tier
  std::optional<double> bar = {};         // m, error bar of the truth
  double motion = 0;                      // m, largest RMS distance from the start
  double until = 0;                       // s
};

/// Runs the translated scene with `method` at the translation's step, and compares it with the source's truth or,
/// without one, with mysim/symplectic-euler on the source at the same step.
TranslatedRun run_translated(const Scene& source, const Translation& translation, const Method& method);

}  // namespace crosscheck
