// The parts of the chapter on contact with a ball; sphere.cpp puts them together.
#pragma once

#include <optional>
#include <string>

#include "experiments/table.h"
#include "report/charts/charts.h"

namespace crosscheck {

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

}  // namespace crosscheck
