// The parts of the chapter on stability; stability.cpp puts them together.
#pragma once

#include <string>
#include <vector>

#include "experiments/table.h"
#include "report/charts/charts.h"

namespace crosscheck {

/// The limits of all scenes: size of the deviation from theory as a figure, where there is one, and a table for each
/// scene. Empty where the table has no rows.
std::vector<Chart> limit_charts(const Table& stability, const std::string& commit);

/// Maps over step and stiffness, step and drag, one for each scene and kind.
std::vector<Chart> map_charts(const Table& cells, const Table& limits, const std::string& commit);

}  // namespace crosscheck
