// What experiment `adequacy` says of grids, in powers of the number of cells: words that a finding and a figure share.
#pragma once

#include <optional>
#include <string>

#include "experiments/adequacy/resolution.h"
#include "experiments/experiment.h"

namespace crosscheck {

inline constexpr auto motion_against_cells = "error of the motion against cells along a side",
                      stiffness_for_sag = "stiffness of all springs for the same sag",
                      stiffness_for_droop = "stiffness of bend springs for the same droop";

/// The fitted power of a quantity from table `adequacy-scaling`; `scene` is empty for bend springs.
std::optional<PowerLaw> power_of(const Rows& rows, const std::string& scene, const std::string& quantity);
/// "4.24 ± 0.03"
std::string power_text(const PowerLaw& power);

/// How bend springs must stiffen, beside the derived 4, and what of the difference is explained: the derivation counts
/// as many bend springs as cells, and a line has half a one less, as none reaches over the free end. Empty where
/// nothing was fitted.
std::string bend_sentence(const Rows& rows);

}  // namespace crosscheck
