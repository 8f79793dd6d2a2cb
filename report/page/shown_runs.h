// Which runs of a scene the page shows first: beside each other, and in the small table of its card.
#pragma once

#include "experiments/tables/table.h"
#include "report/page/page.h"

namespace crosscheck {

/// The representatives of all engines at the scene's own step, which take one rule, and stand beside each other; the
/// recommended run, then the cheapest run within 1 % of each other method: at most nine. `holds` says whether the page
/// has a method's runs of the chart.
std::vector<ShownRun> shown_runs(const ScenePart& part, const TableSet& rows,
                                 const std::function<bool(const std::string& method)>& holds);

/// Rows of their table in scene.html; `lab`: mysim's have a button that opens them in the lab.
Json shown_runs_data(const ScenePart& part, bool lab);

}  // namespace crosscheck
