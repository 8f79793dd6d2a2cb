// What a translation costs: the run of an engine on the numbers that a scene became, beside the truth of the scene.
#pragma once

#include <optional>
#include <string>

#include "reference/parameters/parameters.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// How far the translated run is from what the scene asks for. Never an error where the truth is that of the in-house
/// contact rule, or another engine: a difference.
struct TranslatedRun {
  std::string method;                     // that ran it
  Outcome outcome = {};                   // its verdict and laws that differ
  std::optional<double> error = {};       // m, largest RMS distance over the particles up to `until`, from the truth
  std::optional<double> difference = {};  // m, the same, where no truth stands above the engines
  std::string beside = {};                // what it was held against, with its tier
  std::optional<double> bar = {};         // m, error bar of the truth
  double motion = 0;                      // m, largest RMS distance from the start
  double until = 0;                       // s
};

/// Runs the scene that the engine's numbers stand for by `method` at the translation's step, and holds it against the
/// source's truth; where there is none, against mysim/symplectic-euler on the source at the same step.
TranslatedRun run_translated(const Scene& source, const Translation& translation, const Method& method);

}  // namespace crosscheck
