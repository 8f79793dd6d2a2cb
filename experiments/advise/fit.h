// Fits a scene's unset parameters to its wishes.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// A parameter written as "fit" in the file. All that are of one kind are one value: every mass, every stiffness; where
/// anisotropy is wished, the stiffness of each family.
struct Unknown {
  std::string name, unit;          // "stiffness", "N/m"
  std::vector<std::string> paths;  // where it stands in the file
  double value = 0;
};

struct WishResult {
  static constexpr double tolerance = 5e-4;  // 1, by which `own` may differ from `reached`
  std::string name, unit;
  double wished;
  double reached;    // the scene's value, converged in the step
  double own = NAN;  // the value in a run of the file, by its method at its step
  bool kept() const { return std::abs(own - reached) <= tolerance * std::abs(reached); }
};

/// The wishes that `scene` fulfils, and those that `file`, a scene to be run in its place, does by its own method, with
/// the step of `file` halved until it keeps them (WishResult::kept), or the step no longer helps. Wishes that cannot be
/// measured are left out.
std::vector<WishResult> keep_wishes(const Scene& scene, Scene& file);

struct FitResult {
  Scene scene;
  std::string toml;
  std::vector<Unknown> unknowns;
  std::vector<WishResult> wishes;
};

/// True when the text of a scene file holds values to be fitted. Throws InputError when it is no TOML.
bool has_unknowns(std::string_view text, const std::string& name);

/// Finds the values by simulation: on a coarse grid over decades first, then by damped Gauss-Newton steps in the
/// logarithms of the parameters and of the measures, until each wish is met within 0.02 %. The step becomes at most
/// half of leapfrog's limit, and so short that a run of the file keeps its wishes, if one does. Throws InputError where
/// values are to be fitted without as many wishes, or that cannot be fitted, and CannotGuarantee where a wish cannot be
/// measured or is not met within 2 %.
FitResult fit_to_wishes(std::string_view text, const std::string& name);

}  // namespace crosscheck
