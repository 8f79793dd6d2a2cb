// Parts of the chapters on contact and stability that are implemented in other files.
#pragma once

#include <vector>

#include "experiments/tables/stability.h"
#include "report/figures/charts.h"
#include "report/findings/summaries.h"

namespace crosscheck {

/// A particle on balls and planes (contact_particle.cpp).
std::vector<Chart> particle_charts(const TableSet& tables, const std::string& commit);

/// Over step and stiffness, or step and drag: one map per scene and kind (stability_maps.cpp).
std::vector<Chart> map_charts(const std::vector<MapRow>& cells, const std::vector<MapLimitRow>& limits,
                              const std::string& commit);

}  // namespace crosscheck
