// Experiment `energy`: where it went, whether the residual is bounded, and what rules take by themselves.
#include <fmt/format.h>

#include "experiments/cells.h"
#include "report/charts/energy_parts.h"

namespace crosscheck {

/// The longest time and its steps, of any run of the scene: "100 s, 100000 steps of 0.001 s".
std::string length_text(const Table& table, const std::string& scene) {
  double end = 0, step = 0;
  long steps = 0;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "scene") == scene && number_at(table, i, "end", 0) >= end)
      if (const long n = std::get<long>(table.at(i, "steps")); n >= steps)
        steps = n, step = number_at(table, i, "step", 0), end = number_at(table, i, "end", 0);
  return fmt::format("{:.4g} s, up to {} steps of {}", end, steps, step_text(step));
}

std::vector<Chart> energy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const Table* table = input.result.table("energy")) {
    for (const std::string& scene : distinct(*table, "scene"))
      if (auto chart = budget_chart(*table, scene, input.commit)) charts.push_back(std::move(*chart));
    for (const std::string& scene : distinct(*table, "scene")) {
      const Table* rows = input.result.table(scene + "-ledger");
      bool undamped = false;
      for (size_t i = 0; i < table->rows.size(); ++i)
        undamped |= text_at(*table, i, "scene") == scene && flag_at(*table, i, "undamped");
      if (undamped && rows) charts.push_back(drift_chart(*table, *rows, scene, input.commit));
    }
  }
  if (const Table* table = input.result.table("energy-damping")) charts.push_back(damping_chart(*table, input.commit));
  return charts;
}

}  // namespace crosscheck
