// Results of the bench as printable lines: on the terminal and in the figure.
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

/// One comparison: all rows that differ only in mysim's instruction set.
struct BenchLine {
  std::string work, scene, subject;      // subject: the peer, or mysim's kernel compared with the naive loop
  std::string label;                     // the subject and, if given, the accuracy
  std::string detail;                    // times behind the ratio, for the best instruction set; or the reason for a
                                         // missing ratio
  std::optional<Timing> best, baseline;  // ratios
  bool representative = true;            // shown in the figure

  /// "same error, 32 × 32"
  std::string heading() const;
};

/// One line per comparison, in the order of the rows; for the shipped scenes only the one with the smallest gain of the
/// engine's own kernel. The figure shows the kernels on the middle cloth, and each peer's best run.
std::vector<BenchLine> bench_lines(const std::vector<BenchRow>& rows);

/// All representative ratios of CPU times: best and baseline instruction sets as two markers.
DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& commit);

struct BenchOptions {
  bool full = false;
  std::filesystem::path out = "out/bench";
  std::string command_line;
  std::string methods = {};  // further methods to compare with, separated by commas; may be empty
};
/// Runs a suite (the short, the long or the caller's) and prints and writes its results.
int bench_command(const BenchOptions& options, const BenchSuite& plan);

}  // namespace crosscheck
