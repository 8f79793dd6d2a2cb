// Known disagreements: one figure each, with the scene's own curve and that of Bullet.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/disagreements/disagreements.h"
#include "experiments/tables/disagreements.h"
#include "report/figures/charts.h"

namespace crosscheck {
namespace {

/// The method's own style, or a spare colour if the method occurred before with other options.
MethodStyle style_after(int before, const std::string& method) {
  static constexpr std::pair<const char*, const char*> spare[] = {
      {"#E69F00", "(6,3)"}, {"#CC79A7", "(2,2)"}, {"#332288", "(10,3,2,3)"}, {"#999933", "(16,3,2,3)"}};
  const MethodStyle own = style_of(method);
  if (before == 0) return own;
  const auto& [colour, dash] = spare[(before - 1) % 4];
  return {colour, dash, own.marker + before};
}

}  // namespace

std::vector<Chart> disagreement_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const auto known = disagreements();
  for (const DisagreementRow& row : rows_of<DisagreementRow>(input.result)) {
    const Table& table = *input.result.table(row.name + "-disagreement");
    const Column& quantity = table.columns.back();
    Figure f;
    f.x.low = 0;
    const bool ratio = quantity.unit.find('/') != std::string::npos;
    f.y.label = fmt::format("{} / {}", quantity.name, ratio ? "(" + quantity.unit + ")" : quantity.unit);
    const auto found = std::ranges::find(known, row.name, &Disagreement::name);
    f.y.logarithmic = found != known.end() && !found->value;
    std::map<std::string, int> seen;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      const std::string& curve = text_at(table, i, "curve");
      if (f.curves.empty() || f.curves.back().title != curve) {
        const std::string& name = text_at(table, i, "method");
        const std::string method = name.substr(0, name.find('+'));
        f.curves.push_back({curve, style_after(seen[method]++, method), {}});
      }
      Curve& own = f.curves.back();
      const double t = *number_at(table, i, "t"), y = *number_at(table, i, quantity.name);
      if (y > 0 || !f.y.logarithmic) own.points.emplace_back(t, y);
      const std::string& verdict = text_at(table, i, "verdict");
      const bool last = i + 1 == table.rows.size() || text_at(table, i + 1, "curve") != curve;
      if (last && verdict != "ok" && !own.points.empty())
        f.failures.push_back({fmt::format("{}: {}", curve, failure_class(verdict)), own.style, own.points.back().first,
                              own.points.back().second});
    }
    // removes the curves of the reference and of failed runs; failed runs are drawn as crosses
    std::erase_if(f.curves, [](const Curve& c) { return c.points.size() < 2; });
    charts.push_back(
        described("{name}-disagreement", std::move(f), "name"_a = row.name, "what"_a = row.what,
                  "world"_a = row.world.starts_with(engine_prefix) ? row.world.substr(engine_prefix.size()) : row.world,
                  "cause"_a = row.cause, "effect"_a = row.effect,
                  "threads"_a = row.threads.empty() ? "no report known" : row.threads, "state"_a = row.state,
                  "commit"_a = input.commit));
  }
  return charts;
}

}  // namespace crosscheck
