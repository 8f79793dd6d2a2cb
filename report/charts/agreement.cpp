// How far Bullet's worlds are from mysim's symplectic Euler over time: round-off, another law, or another contact rule.
#include <fmt/format.h>

#include "report/charts/charts.h"
#include "report/findings_text.h"

namespace crosscheck {

std::vector<Chart> agreement_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const SceneFacts& facts = input.facts[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (!table) continue;
    Figure f;
    f.name = scene.name + "-agreement";
    f.title = scene.name + ": distance from mysim/symplectic-euler";
    f.caption = caption_of(scene, input.commit);
    f.tier = another_engine(facts);
    f.x = {"t / s", false, 0.0, scene.duration};
    f.y = {"RMS difference / m", true, 1e-17, std::nullopt};  // below round-off nothing is told
    for (const MethodFacts& m : facts.methods) {
      if (!m.ok() || m.method.starts_with("mysim/")) continue;
      Curve curve{m.method, style_of(m.method), points_of(*table, m.method, "difference", true)};
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    if (f.curves.empty()) continue;
    if (scene.window < scene.duration) f.window = {scene.window, "single positions are not comparable from here"};
    const MethodFacts* same = facts.find(theirs);
    f.finding = same && same->difference
                    ? fmt::format("Bullet's explicit deformable world stays within {} of mysim until {:.3g} s.",
                                  nice_length(*same->difference), scene.window)
                    : "Differences from mysim over time.";
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
