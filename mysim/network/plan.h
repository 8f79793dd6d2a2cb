// Sorts the springs of a network into diagonals, pairs and plain ones.
#pragma once

#include "mysim/network/memory.h"

namespace crosscheck::network {

/// Which springs go which way: what costs least.
struct Plan {
  std::vector<Turned> diagonals;
  Turned pairs;
  std::vector<Spring> plain;  // as they were
};
Plan plan_for(const std::vector<Spring>& springs, int particles, const Costs& costs);

}  // namespace crosscheck::network
