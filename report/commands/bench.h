// The results of the bench as lines for people: on the terminal and in the figure.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tables/table.h"
#include "report/figures/figure.h"

namespace crosscheck {

struct BenchSuite;

/// The ratio of a peer's time to mysim's, with its 90 % interval.
struct BenchRatio {
  double ratio, low, high;
};

struct BenchLine {
  std::string group;                      // a heading: the comparison
  std::string heading;                    // the same in few words, for the figure
  std::string label;                      // the peer, and at which accuracy
  std::string detail;                     // times or rates behind the ratio; of the best path
  std::optional<BenchRatio> best, plain;  // best instructions; the baseline
  std::string remark = {};                // why there is no ratio
  bool representative = true;             // of several lines about one peer the one where it does best
  bool wall = false;                      // the ratio is one of times on the wall, not of CPU times
};

/// From the tables of bench(). Kernels on the middle one of the selected cloths; of the shipped scenes the one where
/// the engine's own kernel gains least; all runs of all peers; two threads against one.
std::vector<BenchLine> bench_lines(const TableSet& rows);

/// The name of the best instructions in the tables: "avx512".
std::string best_instruction_set(const TableSet& rows);

inline std::string nice_seconds(double seconds) {
  if (seconds >= 0.1) return fmt::format("{:.2f} s", seconds);
  if (seconds >= 1e-4) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} µs", 1e6 * seconds);
}

/// "sheet-32x32-two-stiffnesses" as "32 × 32, two stiffnesses".
inline std::string size_text(const std::string& scene) {
  std::string text = scene.substr(scene.find('-') + 1);
  for (const auto& [from, to] : {std::pair{"x", " × "}, {"-", ", "}, {"-", " "}})
    if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, 1, to);
  return text;
}

/// All ratios, of each peer the one where it does best: best instructions and the baseline as two markers.
DotPlot bench_figure(const std::vector<BenchLine>& lines, const std::string& instructions, const std::string& commit);

struct BenchOptions {
  bool full = false;
  std::filesystem::path out = "out/bench";
  std::string command_line;
  std::string methods = {};  // to compare with as well, separated by commas; may be empty
};
/// The short suite, the long one, or the caller's.
int bench_command(const BenchOptions& options, const BenchSuite& plan);

}  // namespace crosscheck
