// The cloth of the scene cloth-hang at other resolutions.
#pragma once

#include "mysim/scene.h"

namespace crosscheck {

/// cloth-hang with n x n particles: 1 m, 0.25 kg in all, 200 N/m for all three families, two corners pinned, drag 4/s.
/// The step is 1e-2 s / n, 0.45 of the explicit limit at each size, since particles get lighter as n^-2. It begins as a
/// wave 5 cm high, so that springs pull from the first step on. With a sphere (0.3 m) below its middle where asked.
Scene sized_cloth(int n, bool sphere = false);

}  // namespace crosscheck
