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

/// One comparison: merges all rows that differ only in mysim's instruction set.
struct BenchLine {
  std::string work, scene, subject;  // subject: the peer, or mysim's kernel if the peer is the naive loop
  std::string label;
  std::string detail;  // the two times of the ratio (best instruction set), or the reason why there is no ratio
  std::optional<Timing> best, baseline;  // ratios
  bool representative = true;            // shown in the figure

  /// "same error, 32 × 32"
  std::string heading() const;
};

/// One line per comparison, in the order of the rows. Of the shipped scenes, keeps only the one on which
/// mysim's kernel gains least. The figure shows kernels on the middle cloth only, and only the best run of each peer.
std::vector<BenchLine> bench_lines(const std::vector<BenchRow>& rows);

/// CPU-time ratios of the representative lines: two markers each, for the best and the baseline instruction set.
DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& commit);

struct BenchOptions {
  bool full = false;
  std::filesystem::path out = "out/bench";
  std::string command_line;
  std::string methods = {};  // further methods to compare with, separated by commas
};
int bench_command(const BenchOptions& options, const BenchSuite& plan);

}  // namespace crosscheck
