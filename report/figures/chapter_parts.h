// The parts of the chapters on contact and stability that have files of their own.
#pragma once

#include <cmath>
#include <vector>

#include "experiments/tables/stability.h"
#include "report/figures/charts.h"

namespace crosscheck {

/// The step of the rows that is nearest to a millisecond, s.
template <class Row>
double usual_step(const std::vector<Row>& rows) {
  return std::ranges::min(rows, {}, [](const Row& row) { return std::abs(row.step - 1e-3); }).step;
}

/// A particle and a ball: slopes, rebound, separation, order (sphere_particle.cpp).
std::vector<Chart> particle_charts(const TableSet& tables, const std::string& commit);

/// Maps over step and stiffness, step and drag, one for each scene and kind (stability_maps.cpp).
std::vector<Chart> map_charts(const std::vector<MapRow>& cells, const std::vector<MapLimitRow>& limits,
                              const std::string& commit);

}  // namespace crosscheck
