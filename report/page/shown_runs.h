#pragma once

#include "experiments/tables/table.h"
#include "report/page/page.h"

namespace crosscheck {

/// The runs of a scene that the page shows, at most nine: runs of the engines' representatives, which follow the same
/// rule at the scene's own step and are shown side by side; the recommended run; and, for all other methods, the
/// cheapest run within 1 %. `holds`: returns true if the page has the runs of a method in the chart.
std::vector<ShownRun> shown_runs(const ScenePart& part, const TableSet& rows,
                                 const std::function<bool(const std::string& method)>& holds);

/// Rows of a table in scene.html; if `lab`, buttons open mysim's runs in the lab.
Json shown_runs_data(const ScenePart& part, bool lab);

}  // namespace crosscheck
