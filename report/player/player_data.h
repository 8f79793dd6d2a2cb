// A scene as JSON for the page's player (player.js): motions, springs, obstacles, colours,
// plot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The results in lock-step, and the truth behind them where there is one. Distances from the truth are there up to the
/// scene's window and the truth's end. Empty when there is nothing to play: no result has frames, or the scene has too
/// many particles for a page (see thinned_trajectory.h).
std::string player_json(const Scene& scene, const std::vector<const Result*>& answers,
                        const std::optional<Truth>& truth);

/// The same of a scene in which nothing has moved yet, without methods: where cells of its maps are played.
std::string stage_json(const Scene& scene);

}  // namespace crosscheck
