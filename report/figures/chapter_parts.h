// The parts of which chapters on adequacy, energy, contact and stability are put together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/table.h"
#include "report/figures/charts.h"

namespace crosscheck {

// The parts of the chapter on how little model is enough; adequacy.cpp puts them together.

/// The same cloth on other grids, and how stiffness must follow the grid.
std::vector<Chart> grid_charts(const Rows& rows, const std::string& commit);

// The parts of the chapter on energy; energy.cpp puts them together.

/// The longest time and its steps, of any run of the scene: "100 s, up to 100000 steps of 0.001 s".
std::string length_text(const Table& energy, const std::string& scene);

/// StackedBars of a scene in which something takes or gives energy; empty of others.
std::optional<Chart> budget_chart(const Table& energy, const std::string& scene, const std::string& commit);
/// The residual over time on a scene that nothing damps.
Chart drift_chart(const Table& energy, const Table& ledger, const std::string& scene, const std::string& commit);
/// The drag that rules add by themselves.
Chart damping_chart(const Table& damping, const std::string& commit);

// The parts of the chapter on contact with a ball; sphere.cpp puts them together.

/// The step of the table that is nearest to a millisecond, s.
double usual_step(const Table& table);

/// Coulomb's law on slopes: the way that a particle slides, against friction / tan(slope); and a table of answers.
Chart cone_law(const Table& cones, const std::string& commit);
/// Who sticks, who slides, who creeps, cell by cell; empty where none of the methods shown was asked.
std::optional<Chart> cone_map(const Table& cones, const std::string& commit);
Chart rebound_chart(const Table& rebounds, const std::string& commit);
Chart leaving_chart(const Table& leavings, const std::string& commit);

/// Deepest particle and deepest triangle of a scene, by method and step; empty where nothing was inside.
std::optional<Chart> depth_chart(const Table& depths, const std::string& scene, const std::string& commit);
/// How a scene with a draped body ends, by method and step.
PageTable drape_table(const Table& drapes, const std::string& scene);
/// The cloth that slides off, by four that answer differently.
Chart drape_snapshot(const Table& drapes);

// The parts of the chapter on stability; stability.cpp puts them together.

/// The limits of all scenes: size of the deviation from theory as a figure, where there is one, and a table for each
/// scene. Empty where the table has no rows.
std::vector<Chart> limit_charts(const Table& stability, const std::string& commit);

/// Maps over step and stiffness, step and drag, one for each scene and kind.
std::vector<Chart> map_charts(const Table& cells, const Table& limits, const std::string& commit);

}  // namespace crosscheck
