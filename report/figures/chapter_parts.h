// The parts of the chapters on contact and stability that have files of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/table.h"
#include "report/figures/charts.h"

namespace crosscheck {

// A particle and a ball (sphere_particle.cpp).

/// The step of the table that is nearest to a millisecond, s.
double usual_step(const Table& table);

/// Coulomb's law on slopes: distance slid over friction coefficient / tan(slope), and a table of results.
Chart cone_law(const Table& cones, const std::string& commit);
/// Methods that stick, slide or creep, cell by cell; empty where none of the methods shown was run.
std::optional<Chart> cone_map(const Table& cones, const std::string& commit);
Chart rebound_chart(const Table& rebounds, const std::string& commit);
std::optional<Chart> leaving_chart(const Table& leavings, const std::string& commit);
/// Error against step of a slide with friction that leaves the ball, with and without +events; empty without a run of
/// both.
std::optional<Chart> contact_order_chart(const Table& orders, const std::string& commit);

/// Maps over step and stiffness, step and drag, one for each scene and kind.
std::vector<Chart> map_charts(const Table& cells, const Table& limits, const std::string& commit);

}  // namespace crosscheck
