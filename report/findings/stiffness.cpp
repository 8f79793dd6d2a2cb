// Findings of experiment `stiffness`: how much softer than asked a cloth is at the step of a game.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/tables/stiffness.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
std::vector<Finding> stiffness_findings(const TableSet& rows) {
  const std::vector<EffectiveStiffnessRow> table = rows_of<EffectiveStiffnessRow>(rows);
  std::map<std::string, std::vector<const EffectiveStiffnessRow*>> by_method;
  constexpr double game = 1. / 60;  // s
  const auto off_game = [&](const EffectiveStiffnessRow& row) { return std::abs(std::log(row.step / game)); };
  double nearest = INFINITY;
  for (const EffectiveStiffnessRow& row : table)
    if (row.net == table.back().net) nearest = std::min(nearest, off_game(row));
  for (const EffectiveStiffnessRow& row : table)
    if (row.net == table.back().net && off_game(row) <= nearest * (1 + 1e-9) && row.by_sag)
      if (const Method* method = builtin_method(row.method); method && method->position_based)
        by_method[row.method].push_back(&row);
  std::vector<Finding> out;
  for (auto& [method, all] : by_method) {
    std::ranges::sort(all, {}, &EffectiveStiffnessRow::iterations);
    const EffectiveStiffnessRow &least = *all.front(), &most = *all.back();
    const std::string more = &least == &most ? ""
                                             : fmt::format(", {} with {}", times_text(1 / *most.by_sag),
                                                           passes_text(most.method, most.iterations));
    out.push_back({.rule = "effective-stiffness",
                   .method = method,
                   .value = 1 / *least.by_sag,
                   .words = {{"step", step_text(least.step)},
                             {"passes", passes_text(least.method, least.iterations)},
                             {"more", more}}});
  }
  return out;
}

}  // namespace crosscheck
