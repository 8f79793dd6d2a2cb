// Cost of a step: by size, by phase, and relative to the machine's peak rates.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cost/cost.h"
#include "experiments/tables/cost.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

Chart size_chart(const std::vector<SizeCostRow>& rows, const std::string& commit) {
  Figure f;
  f.from_costs = true;
  for (const SizeCostRow& row : rows)
    curve_of(f, row.method, style_of(row.method))
        .points.emplace_back(static_cast<double>(row.particles), 1e9 * row.cpu_per_particle);
  const long largest = std::ranges::max(rows, {}, &SizeCostRow::side).side;
  double cheapest = INFINITY;
  for (const SizeCostRow& row : rows | with(&SizeCostRow::side, largest)) cheapest = std::min(cheapest, row.cpu);
  PageTable page{fmt::format("At {0} x {0} particles", largest),
                 {"method", "CPU time per time step / ms", "90 % interval", "force evaluations per time step",
                  "ns per particle", "relative to the cheapest"},
                 {}};
  for (const SizeCostRow& row : rows | with(&SizeCostRow::side, largest))
    page.rows.push_back(
        {row.method, nice(1e3 * row.cpu), fmt::format("{} to {}", nice(1e3 * row.cpu_low), nice(1e3 * row.cpu_high)),
         nice(row.evaluations_per_step), nice(1e9 * row.cpu_per_particle), times_text(row.cpu / cheapest)});
  Chart chart = described("size-cost", std::move(f), "commit"_a = commit);
  chart.tables.push_back(std::move(page));
  return chart;
}

/// Shows only the largest cloth.
Chart phases_chart(const std::vector<PhaseCostRow>& rows) {
  const long largest = std::ranges::max(rows, {}, &PhaseCostRow::side).side;
  PageTable page{fmt::format("CPU time of the phases of a time step, {0} x {0} particles", largest),
                 {"method", "phase", "µs per time step", "interval", "share", "measured as"},
                 {}};
  for (const PhaseCostRow& row : rows | with(&PhaseCostRow::side, largest))
    page.rows.push_back({row.method, row.phase, nice(1e6 * row.cpu),
                         fmt::format("{} to {}", nice(1e6 * row.cpu_low), nice(1e6 * row.cpu_high)),
                         fmt::format("{:.0f} %", 100 * row.share), row.how});
  Chart chart = described("phases-cost", std::monostate{});
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart roofline_chart(const std::vector<RooflineRow>& rows, const std::string& commit) {
  Figure f;
  f.from_costs = true;
  f.x.low = 0.03, f.x.high = 10, f.y.low = 0.3;
  static const MethodStyle roofs[] = {{"#56B4E9", "1", -1}, {"#0072B2", "(6,3)", -1}, {"#332288", "(2,2)", -1}};
  double peak = 0, best = 0, at = 0;
  Curve springs{"springs, 16 x 16 to ", {"#D55E00", "1", 7}, {}, true, true};
  std::string last;
  for (const RooflineRow& row : rows) {
    const double rate = row.rate / 1e9;
    if (row.what.starts_with("peak")) peak = rate;
    if (row.what.starts_with("bandwidth")) {
      const double bandwidth = row.bandwidth.value_or(0) / 1e9;
      f.curves.push_back({fmt::format("{}: {:.0f} GB/s", row.what, bandwidth),
                          roofs[std::min(f.curves.size(), std::size(roofs) - 1)],
                          {{0.03, 0.03 * bandwidth}, {peak / bandwidth, peak}, {10, peak}}});
    }
    if (row.what.starts_with("springs")) {
      springs.points.emplace_back(row.intensity.value_or(0), rate);
      last = row.what.substr(row.what.find(',') + 2);
      if (rate > best) best = rate, at = row.intensity.value_or(0);
    }
  }
  springs.title += last;
  f.curves.push_back(std::move(springs));
  return described("roofline-cost", std::move(f), "best"_a = times_text(best), "intensity"_a = at,
                   "share"_a = 100 * best / peak, "peak"_a = times_text(peak), "flop"_a = flop_per_spring,
                   "bytes"_a = bytes_per_spring, "particle"_a = bytes_per_particle, "commit"_a = commit);
}

}  // namespace

std::vector<Chart> cost_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const auto rows = rows_of<SizeCostRow>(input.result); !rows.empty())
    charts.push_back(size_chart(rows, input.commit));
  if (const auto rows = rows_of<PhaseCostRow>(input.result); !rows.empty()) charts.push_back(phases_chart(rows));
  if (const auto rows = rows_of<RooflineRow>(input.result); !rows.empty())
    charts.push_back(roofline_chart(rows, input.commit));
  return charts;
}

}  // namespace crosscheck
