// report.json: what a report says, as data, and what each sentence rests on.
#pragma once

#include "report/charts/charts.h"
#include "report/grounds.h"
#include "report/page/page.h"

namespace crosscheck {

/// Findings with formula, rows and fingerprints; scenes; tables with their fingerprints; figures, notes, problems.
std::string report_json(const PageContent& page, const AllFindings& findings, const std::vector<Chart>& charts,
                        const Rows& result);

}  // namespace crosscheck
