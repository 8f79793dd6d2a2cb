// Charts as the page draws them (page/chart.js): the numbers of a figure, in six digits, with its words.
#pragma once

#include <span>

#include "mysim/base/json.h"
#include "report/figures/charts.h"

namespace crosscheck {

/// A figure of any kind. Curves of more than 600 points are thinned: of each stretch the first, the lowest, the highest
/// and the last point stay. Null where the chart has no figure.
Json chart_json(const Chart& chart);

/// The look of methods on the page: for each its short title, the name of its colour (style.css), its marker, and
/// whether it is one of those in question, which have a colour in every chart.
Json method_looks_json(std::span<const std::string> methods);

}  // namespace crosscheck
