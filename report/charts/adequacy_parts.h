// The parts of the chapter on how little model is enough; adequacy.cpp puts them together.
#pragma once

#include <string>
#include <vector>

#include "report/charts/charts.h"

namespace crosscheck {

/// The same cloth on other grids, and how stiffness must follow the grid.
std::vector<Chart> grid_charts(const Rows& rows, const std::string& commit);

}  // namespace crosscheck
