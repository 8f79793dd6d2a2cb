// What the player says of a motion.
#pragma once

#include "mysim/json.h"
#include "report/player/shown.h"

namespace crosscheck {

/// Name, looks and what became of it: "name", "colour", "dash", "stops" (s), "failed" (s or null), "failure", "reason",
/// "note" (of different laws), "end", and "known": whether it is the truth.
Json words_json(const Shown& shown);

}  // namespace crosscheck
