// The columns of the tables of experiment `speed-accuracy` that its points fill.
#pragma once

#include "experiments/tables/table.h"

namespace crosscheck {

inline Table results_table() {
  return {"speed-accuracy",
          {{"scene", "1"},
           {"method", "1"},
           {"setting", "1"},
           {"asked", "see setting"},
           {"step", "s"},
           {"steps", "1"},
           {"evaluations", "1"},
           {"verdict", "1"},
           {"end", "s"},
           {"largest error", "m"},
           {"error over time", "m"},
           {"largest difference from converged contact", "m"},
           {"difference from converged contact over time", "m"},
           {"distance to own finest", "m"},
           {"motion", "m"},
           {"until", "s"},
           {"truth", "1"},
           {"truth bar", "m"},
           {"different law", "1"}},
          {}};
}

inline Table timing_table() {
  return {"speed-accuracy-timing-cost",
          {{"scene", "1"},
           {"method", "1"},
           {"setting", "1"},
           {"asked", "see setting"},
           {"part of the run", "1"},
           {"evaluations", "1"},
           {"cpu", "s"},
           {"cpu low", "s"},
           {"cpu high", "s"},
           {"repetitions", "1"},
           {"noise", "1"}},
          {}};
}

}  // namespace crosscheck
