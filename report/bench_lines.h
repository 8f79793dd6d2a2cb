// What the bench found, line by line, as people read it: for the terminal and the figure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/point.h"

namespace crosscheck {

/// How many times somebody's time mysim's is, with its 90 % interval.
struct BenchRatio {
  double ratio, low, high;
};

struct BenchLine {
  std::string group;                      // what is compared, a heading
  std::string heading;                    // the same in few words, for the figure
  std::string label;                      // with whom, at which accuracy
  std::string detail;                     // times or rates behind the ratio; of the best path
  std::optional<BenchRatio> best, plain;  // best instructions; SSE2 alone
  std::string remark = {};                // why there is no ratio
  bool chief = true;                      // of several lines about one peer the one where it does best
  bool wall = false;                      // the ratio is one of times on the wall, not of CPU times
};

/// From the tables of bench(). Kernels on the sheet in the middle of those asked; of the shipped scenes the one where
/// the engine's own way gains least; all runs of all peers; two threads beside one.
std::vector<BenchLine> bench_lines(const Rows& rows);

/// The name of the best instructions in the tables: "avx512".
std::string best_instructions(const Rows& rows);

}  // namespace crosscheck
