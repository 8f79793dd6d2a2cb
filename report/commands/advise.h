// The figure that proves an advice.
#pragma once

#include "experiments/advise/advice.h"
#include "report/figures/figure.h"

namespace crosscheck {

/// Error against cost of everything that was tried, the asked tolerance as a line, the advised run marked; failed runs
/// as crosses at the cost they had spent.
Figure advice_figure(const Advice& advice, const std::string& commit);

}  // namespace crosscheck
