#include "report/charts/bench.h"

#include <fmt/format.h>

#include <algorithm>

namespace crosscheck {
namespace {

std::optional<Dots::Dot> dot_of(const std::optional<BenchRatio>& ratio) {
  if (!ratio) return std::nullopt;
  return Dots::Dot{ratio->ratio, ratio->low, ratio->high};
}

/// A line stands alone in the figure, without its heading.
std::string name_of(const BenchLine& line) {
  if (line.group.starts_with("springs of a sheet")) return "naive loop: " + line.label;
  if (line.group.starts_with("the same error")) {
    const size_t from = line.group.find(" of ") + 4;
    return fmt::format("{}, {}", line.label, line.group.substr(from, line.group.find(',') - from));
  }
  if (line.group.starts_with("the shipped scene")) return "naive loop: " + line.label;
  return "same step: " + line.label;
}

}  // namespace

Dots bench_figure(const std::vector<BenchLine>& lines, const std::string& instructions, const std::string& commit) {
  Dots f;
  f.name = "bench-ratios";
  f.title = "How many times mysim's time the others take";
  f.label = "CPU time over mysim's, in the same run";
  f.from_costs = true;
  f.series = {{fmt::format("mysim with {}", instructions), {"#0072B2", "1", 7}, {}},
              {"mysim with SSE2 alone", {"#D55E00", "1", 6}, {}}};
  std::string group;
  const BenchLine* least = nullptr;
  for (const BenchLine& line : lines) {
    if (!line.chief || !line.best) continue;
    if (!f.names.empty() && line.group != group) f.groups.push_back(f.names.size());
    group = line.group;
    f.names.push_back(name_of(line));
    f.series[0].dots.push_back(dot_of(line.best));
    f.series[1].dots.push_back(dot_of(line.plain));
    if (!least || line.best->ratio < least->best->ratio) least = &line;
  }
  if (least) f.finding = fmt::format("mysim gains least on {}: {:.2g} times.", name_of(*least), least->best->ratio);
  f.caption = fmt::format(
      "CPU time of one core, medians and 90 % intervals of ratios taken round by round; of each peer the run where it "
      "does best; commit {}.",
      commit);
  return f;
}

}  // namespace crosscheck
