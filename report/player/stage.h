// The static part of a scene for the page's player: everything that is the same for all methods.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The truth of a scene, for the player.
struct StageTruth {
  std::string name;            // "truth, exact", "converged contact rule"
  bool rule = false;           // limit of the in-house contact rule: the distance from it is not an error
  double bar = 0, motion = 0;  // m: its error bar, and the scale of errors
};

/// JSON of a scene whose camera must show these positions; empty if the scene is too large for the player.
std::string stage_json(const Scene& scene, const std::vector<Points>& shown, const std::optional<StageTruth>& truth);
/// JSON of a map's scene, which does not move; `with_text` adds its text, so that the lab can open its cells.
std::string stage_json(const Scene& scene, bool with_text);

}  // namespace crosscheck
