// A scene for the page's player, without its runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

struct StageTruth {
  std::string name;            // "truth, exact", "converged contact rule"
  bool rule = false;           // limit of mysim's contact rule: distances from it are not errors
  double bar = 0, motion = 0;  // m: error bar of the truth; size of the motion, which scales errors
};

/// JSON of a scene whose camera must show these positions. Empty if the scene is too large for the player.
std::string stage_json(const Scene& scene, const std::vector<Points>& shown, const std::optional<StageTruth>& truth);
/// JSON of a map's scene, which does not move; `with_text` adds the text with which the lab opens the map's cells.
std::string stage_json(const Scene& scene, bool with_text);

}  // namespace crosscheck
