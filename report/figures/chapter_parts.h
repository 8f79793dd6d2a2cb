// Parts of the chapters on contact and stability that are implemented in other files.
#pragma once

#include <vector>

#include "experiments/tables/stability.h"
#include "report/figures/charts.h"
#include "report/findings/summaries.h"

namespace crosscheck {

/// A particle on balls and planes (contact_particle.cpp).
std::vector<Chart> particle_charts(const TableSet& tables, const std::string& commit);

/// One map per scene and kind, over step and stiffness or over step and drag (stability_maps.cpp).
std::vector<Chart> map_charts(const std::vector<MapRow>& cells, const std::vector<MapLimitRow>& limits,
                              const std::string& commit);

}  // namespace crosscheck
