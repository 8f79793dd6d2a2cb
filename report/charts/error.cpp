// Error over time against the truth, one chart per scene that has one.
#include <fmt/format.h>

#include <algorithm>

#include "report/charts/charts.h"
#include "report/findings_text.h"

namespace crosscheck {

std::vector<Chart> error_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const SceneFacts& facts = input.facts[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (facts.tier.empty() || !(facts.motion > 0) || !table) continue;
    Figure f;
    f.name = scene.name + "-error";
    f.title = scene.name + ": distance from the truth";
    f.caption = caption_of(scene, input.commit);
    f.tier = tier_of(facts);
    f.x = {"t / s", false, 0.0, scene.duration};
    const double top = 10 * facts.motion;
    f.y = {"RMS error / m", true, std::max(facts.bar, 1e-16) / 3, top};
    std::vector<std::string> failed, cut;
    for (const MethodFacts& m : facts.methods) {
      if (!m.supported()) continue;
      Curve curve{m.method, style_of(m.method), {}};
      bool above = false;
      for (const auto& [t, error] : points_of(*table, m.method, "error", true)) {
        above |= error >= top;
        if (error < top) curve.points.emplace_back(t, std::max(error, facts.bar));  // below the bar nothing is known
      }
      if (above) cut.push_back(m.method);
      if (!m.ok()) {
        f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), m.end,
                              curve.points.empty() ? top / 3 : std::min(top / 3, curve.points.back().second * 3)});
        failed.push_back(m.method);
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    f.floor = {"error bar of the truth", facts.bar};
    f.finding = fmt::format("Errors of {} methods over {:.3g} s{}.", f.curves.size(), scene.duration,
                            failed.empty() ? "" : fmt::format("; failed: {}", failed.size()));
    if (!cut.empty())
      f.caption += fmt::format(" Not drawn: errors above ten times the motion ({}), which {} {}.", nice_length(top),
                               joined(cut), cut.size() == 1 ? "has" : "have");
    if (f.curves.empty() && f.failures.empty()) continue;
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
