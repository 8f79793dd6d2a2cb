// What a scene with contact converges to in the step, under the in-house contact rule.
#pragma once

#include <optional>

#include "reference/truth.h"

namespace crosscheck {

/// mysim's leapfrog at 1/8, 1/16 and 1/32 of the scene's step. The answer holds as long as the last
/// difference (RMS over the particles, largest so far) is at most 2/3 of the one before, as at order 0.6 or more: with
/// contact every stepper is of first order on smooth motion. It ends 0.3 s after the first touch of a scene of several
/// free particles, and with the scene's window; the samples of the truth end there too. The bar is the last difference
/// over (its ratio - 1), what is left of a geometric series; at order 1 the difference itself. None where nothing
/// is touched, where no order is seen from the first touch on (after a hard impact, say), or where the bar exceeds a
/// hundredth of the motion.
std::optional<Truth> contact_truth(const Scene& scene, const Run& run);

}  // namespace crosscheck
