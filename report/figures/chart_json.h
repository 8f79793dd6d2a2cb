// Charts for the page (page/chart/): texts, and numbers with six digits.
#pragma once

#include <span>

#include "mysim/base/json.h"
#include "report/figures/charts.h"

namespace crosscheck {

/// JSON of a chart, or null if the chart has no figure. Curves of more than 600 points are thinned: each stretch keeps
/// its first, lowest, highest and last point.
Json chart_json(const Chart& chart);

/// Appearance of each method on the page: short title, colour name (style.css), marker, and whether it is a main
/// method, which is coloured in every chart.
Json method_looks_json(std::span<const std::string> methods);

}  // namespace crosscheck
