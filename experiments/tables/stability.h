// The columns of the tables of experiment `stability`.
#pragma once

#include "experiments/tables/table.h"

namespace crosscheck {

/// Largest stable steps; precision: the width of the bracket from `held` to `failed`, over `held`.
inline Table limits_table() {
  return {"stability",
          {{"scene", "1"},
           {"method", "1"},
           {"state", "1"},
           {"prediction", "1"},
           {"predicted limit", "s"},
           {"binding omega", "rad/s"},
           {"binding gamma", "1/s"},
           {"measurement", "1"},
           {"measured limit", "s"},
           {"held", "s"},
           {"failed", "s"},
           {"deviation", "1"},
           {"verdict above", "1"},
           {"steps", "1"},
           {"reason", "1"},
           {"precision", "1"}},
          {}};
}

/// Growth of one mode in each step.
inline Table growth_table() {
  return {"stability-growth",
          {{"scene", "1"},
           {"method", "1"},
           {"omega", "rad/s"},
           {"gamma", "1/s"},
           {"step", "s"},
           {"h omega", "1"},
           {"share of limit", "1"},
           {"predicted growth", "1"},
           {"measured growth", "1"},
           {"deviation", "1"}},
          {}};
}

/// Cells of maps.
inline Table map_table() {
  return {"stability-map",
          {{"scene", "1"},
           {"method", "1"},
           {"map", "1"},
           {"value", "see map"},
           {"step", "s"},
           {"verdict", "1"},
           {"end", "s"},
           {"growth", "1"}},
          {}};
}

/// Limits of the rows of maps.
inline Table map_limit_table() {
  return {"stability-map-limit",
          {{"scene", "1"},
           {"method", "1"},
           {"map", "1"},
           {"value", "see map"},
           {"predicted limit", "s"},
           {"held", "s"},
           {"failed", "s"}},
          {}};
}

/// Cells that change in runs ten times longer.
inline Table map_check_table() {
  return {"stability-map-check",
          {{"scene", "1"}, {"method", "1"}, {"map", "1"}, {"steps", "1"}, {"cells", "1"}, {"changed", "1"}},
          {}};
}

}  // namespace crosscheck
