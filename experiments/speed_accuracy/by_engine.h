// The cheapest run of each engine within an accuracy, beside mysim's.
#pragma once

#include <string>
#include <vector>

#include "experiments/speed_accuracy/conclude.h"
#include "experiments/table.h"

namespace crosscheck {

/// "mysim" of "mysim/leapfrog": whose run it is.
std::string engine_of(const std::string& method);

/// The table "speed-accuracy-engines-cost", empty.
Table engines_cost_table();

/// Adds a row for each engine that has a timed run within `bound` (m), what the truth's bar takes off included: its
/// cheapest, and how many times as long as mysim's cheapest it takes, from `low` to `high` the widest that both 90 %
/// intervals allow; and which part of each was timed, the rest being scaled. Without a run of mysim within the bound no
/// quotient is given.
void add_by_engine(const std::string& scene, double part_of_motion, const std::string& measure, double bound,
                   const std::vector<WorkPoint>& points, Table& table);

}  // namespace crosscheck
