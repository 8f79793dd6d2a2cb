// The results of the bench as lines for people: on the terminal and in the figure.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/bench.h"
#include "experiments/timing/timing.h"
#include "report/figures/figure.h"

namespace crosscheck {

struct BenchSuite;

/// One comparison: all rows that differ by mysim's instructions only.
struct BenchLine {
  std::string work, scene, subject;      // subject: the peer, or mysim's kernel beside the naive loop
  std::string label;                     // the subject, and at which accuracy
  std::string detail;                    // times behind the ratio, in the best instructions; or why there is no ratio
  std::optional<Timing> best, baseline;  // ratios
  bool representative = true;            // shown in the figure

  /// "same error, 32 × 32"
  std::string heading() const;
};

/// The lines of all rows, in their order; of the shipped scenes only the one where the engine's own kernel gains
/// least. In the figure stand the kernels on the middle one of the cloths, and of each peer the run where it does best.
std::vector<BenchLine> bench_lines(const std::vector<BenchRow>& rows);

/// All representative ratios of CPU times: best instructions and the baseline as two markers.
DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& commit);

struct BenchOptions {
  bool full = false;
  std::filesystem::path out = "out/bench";
  std::string command_line;
  std::string methods = {};  // to compare with as well, separated by commas; may be empty
};
/// The short suite, the long one, or the caller's.
int bench_command(const BenchOptions& options, const BenchSuite& plan);

}  // namespace crosscheck
