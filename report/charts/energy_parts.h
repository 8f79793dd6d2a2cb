// The parts of the chapter on energy; energy.cpp puts them together.
#pragma once

#include <optional>
#include <string>

#include "report/charts/charts.h"

namespace crosscheck {

/// The longest time and its steps, of any run of the scene: "100 s, up to 100000 steps of 0.001 s".
std::string length_text(const Table& energy, const std::string& scene);

/// Bars of a scene in which something takes or gives energy; empty of others.
std::optional<Chart> budget_chart(const Table& energy, const std::string& scene, const std::string& commit);
/// The residual over time on a scene that nothing damps.
Chart drift_chart(const Table& energy, const Table& ledger, const std::string& scene, const std::string& commit);
/// The drag that rules add by themselves.
Chart damping_chart(const Table& damping, const std::string& commit);

}  // namespace crosscheck
