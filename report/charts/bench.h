// The figure of `crosscheck bench`.
#pragma once

#include "report/bench_lines.h"
#include "report/dots.h"

namespace crosscheck {

/// All ratios, of each peer the one where it does best: best instructions and SSE2 alone as two markers.
Dots bench_figure(const std::vector<BenchLine>& lines, const std::string& instructions, const std::string& commit);

}  // namespace crosscheck
