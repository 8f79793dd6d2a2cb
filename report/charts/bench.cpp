#include "report/charts/bench.h"

#include <fmt/format.h>

#include <algorithm>

namespace crosscheck {
namespace {

std::optional<Dots::Dot> dot_of(const std::optional<BenchRatio>& ratio) {
  if (!ratio) return std::nullopt;
  return Dots::Dot{ratio->ratio, ratio->low, ratio->high};
}

}  // namespace

Dots bench_figure(const std::vector<BenchLine>& lines, const std::string& instructions, const std::string& commit) {
  Dots f;
  f.name = "bench-ratios";
  f.title = "CPU time of others over mysim's";
  f.label = "how many times mysim's time";
  f.from_costs = true;
  f.series = {{fmt::format("mysim with {}", instructions), {"#0072B2", "1", 7}, {}},
              {"mysim with SSE2 alone", {"#D55E00", "1", 6}, {}}};
  std::string heading;
  const BenchLine* least = nullptr;
  for (const BenchLine& line : lines) {
    // the plain loop is nothing that mysim runs, and the axis is one of CPU time
    if (!line.chief || !line.best || line.wall || line.label.starts_with("plain loop")) continue;
    if (line.heading != heading) f.headings.emplace_back(f.names.size(), line.heading);
    heading = line.heading;
    f.names.push_back(line.label);
    f.series[0].dots.push_back(dot_of(line.best));
    f.series[1].dots.push_back(dot_of(line.plain));
    if (!least || line.best->ratio < least->best->ratio) least = &line;
  }
  if (least)
    f.finding =
        fmt::format("mysim gains least on {} ({}): {:.2g} times.", least->label, least->heading, least->best->ratio);
  f.caption = fmt::format(
      "CPU time of one core, medians and 90 % intervals of ratios taken round by round; of each peer the run where it "
      "does best; commit {}.",
      commit);
  return f;
}

}  // namespace crosscheck
