// The cost of a translation in accuracy: the run of a translated scene, compared with the truth of the original scene.
#pragma once

#include <optional>
#include <string>

#include "reference/parameters/parameters.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Distance of the translated run from the original scene's solution. It is a difference, not an error, if the truth is
/// that of the in-house contact rule or another engine.
struct TranslatedRun {
  std::string method;                     // that ran it
  Outcome outcome = {};                   // its verdict and different laws
  std::optional<double> error = {};       // m, largest RMS distance over the particles from the truth up to `until`
  std::optional<double> difference = {};  // m, the corresponding distance if there is no truth independent of engines
  std::string beside = {};                // reference for the comparison, with its tier
  std::optional<double> bar = {};         // m, error bar of the truth
  double motion = 0;                      // m, largest RMS distance from the start
  double until = 0;                       // s
};

/// Runs the scene that the engine's numbers describe with `method` at the translation's step, and compares it with the
/// source's truth. Without a truth, compares it with mysim/symplectic-euler on the source at the same step.
TranslatedRun run_translated(const Scene& source, const Translation& translation, const Method& method);

}  // namespace crosscheck
