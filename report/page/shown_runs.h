// Selects the runs of a scene that the page shows first: side by side, and in the small table of its card.
#pragma once

#include "experiments/tables/table.h"
#include "report/page/page.h"

namespace crosscheck {

/// First the representatives of all engines at the scene's own step, which follow the same rule and are shown side by
/// side; then the recommended run, then the cheapest run within 1 % of each other method: at most nine. `holds`: true
/// if the page has a method's runs of the chart.
std::vector<ShownRun> shown_runs(const ScenePart& part, const TableSet& rows,
                                 const std::function<bool(const std::string& method)>& holds);

/// Rows of their table in scene.html; `lab`: mysim's runs have a button that opens them in the lab.
Json shown_runs_data(const ScenePart& part, bool lab);

}  // namespace crosscheck
