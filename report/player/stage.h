// A scene as the page's player needs it beside its runs: what no method moves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The truth of a scene, for the player.
struct StageTruth {
  std::string name;            // "truth, exact", "converged contact rule"
  bool rule = false;           // limit of the in-house contact rule: the distance from it is no error
  double bar = 0, motion = 0;  // m: its error bar, and the scale of errors
};

/// JSON of a scene whose camera has to show these positions; empty if the scene is too large to be played.
std::string stage_json(const Scene& scene, const std::vector<Points>& shown, const std::optional<StageTruth>& truth);
/// JSON of a map's scene, in which nothing moves; with its text if the lab is to open its cells.
std::string stage_json(const Scene& scene, bool with_text);

}  // namespace crosscheck
