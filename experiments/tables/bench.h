// The columns of the tables of equal_error().
#pragma once

#include "experiments/tables/table.h"

namespace crosscheck {

/// Each run of a peer twice, once for each path of mysim. `evaluations` are the right-hand side's; of Bullet's worlds
/// steps. `cpu` is that of the whole run, from the part that was timed in turns; beside it stands what the whole run
/// took when it was run once, for its error.
inline Table equal_error_table() {
  return {"bench-equal-error-cost",
          {{"scene", "1"},           {"peer", "1"},
           {"model", "1"},           {"setting", "1"},
           {"asked", "see setting"}, {"verdict", "1"},
           {"error", "m"},           {"truth bar", "m"},
           {"evaluations", "1"},     {"cpu", "s"},
           {"cpu low", "s"},         {"cpu high", "s"},
           {"part timed", "1"},      {"cpu of the one whole run", "s"},
           {"build", "1"},           {"path of mysim", "1"},
           {"instructions", "1"},    {"mysim", "1"},
           {"step of mysim", "s"},   {"error of mysim", "m"},
           {"cpu of mysim", "s"},    {"ratio", "1"},
           {"ratio low", "1"},       {"ratio high", "1"},
           {"remark", "1"}},
          {}};
}

inline Table own_runs_table() {
  return {"bench-own-runs-cost",
          {{"scene", "1"},
           {"method", "1"},
           {"step", "s"},
           {"verdict", "1"},
           {"error", "m"},
           {"truth bar", "m"},
           {"evaluations", "1"},
           {"path of mysim", "1"},
           {"instructions", "1"},
           {"cpu", "s"},
           {"cpu low", "s"},
           {"cpu high", "s"}},
          {}};
}

}  // namespace crosscheck
