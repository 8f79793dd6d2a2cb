// Fits a scene's unset parameters to its wishes.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// A parameter written as "fit" in the file. All parameters of one kind (such as all masses) share one value. If the
/// file wishes for anisotropy, each family of springs has its own stiffness.
struct Unknown {
  std::string name, unit;          // "stiffness", "N/m"
  std::vector<std::string> paths;  // key paths at which the parameter occurs in the file
  double value = 0;
};

struct WishResult {
  static constexpr double tolerance = 5e-4;  // 1, largest relative difference between `own` and `reached`
  std::string name, unit;
  double wished;
  double reached;    // value in the scene, converged in the step
  double own = NAN;  // value in a run of the file, with its method and step
  bool kept() const { return std::abs(own - reached) <= tolerance * std::abs(reached); }
};

/// Measures each wish twice: in `scene`, converged in the step; and in `file`, the scene that will be run, with the
/// file's own method and step. Halves the step of `file` until WishResult::kept holds or a shorter step no longer
/// helps. Leaves out wishes that cannot be measured.
std::vector<WishResult> keep_wishes(const Scene& scene, Scene& file);

struct FitResult {
  Scene scene;
  std::string toml;
  std::vector<Unknown> unknowns;
  std::vector<WishResult> wishes;
};

/// True if a scene file contains values to be fitted. Throws InputError if it is not valid TOML.
bool has_unknowns(std::string_view text, const std::string& name);

/// Finds the values by simulation: first on a coarse grid over decades, then by damped Gauss-Newton steps in the
/// logarithms of parameters and measures, until each wish is met within 0.02 %. The step is at most half of leapfrog's
/// limit and, if possible, so short that a run of the file keeps its wishes. Throws InputError if there are more or
/// fewer wishes than values, or a value cannot be fitted. Throws CannotGuarantee if a wish cannot be measured or is not
/// met within 2 %.
FitResult fit_to_wishes(std::string_view text, const std::string& name);

}  // namespace crosscheck
