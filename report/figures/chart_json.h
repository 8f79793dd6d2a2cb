// Charts for the page (page/chart/): the numbers of a figure, with six digits, and its texts.
#pragma once

#include <span>

#include "mysim/base/json.h"
#include "report/figures/charts.h"

namespace crosscheck {

/// A figure of any kind. Curves of more than 600 points are thinned: each stretch keeps its first, lowest, highest and
/// last point. Null if the chart has no figure.
Json chart_json(const Chart& chart);

/// Appearance of methods on the page. For each: short title, name of its colour (style.css), marker, and whether it is
/// one of the main methods, which are coloured in every chart.
Json method_looks_json(std::span<const std::string> methods);

}  // namespace crosscheck
