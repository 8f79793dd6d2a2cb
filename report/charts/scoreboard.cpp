// One look: the error of every method on every scene, in parts of the scene's motion; failed runs as crosses on top.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/charts.h"

namespace crosscheck {

std::vector<Chart> scoreboard_charts(const ChartInput& input) {
  Figure f;
  f.name = "scoreboard";
  f.title = "Error of each method at the scene's own step";
  f.x = {"", false, -0.6, std::nullopt};
  f.y = {"largest RMS error / motion of the scene", true, std::nullopt, 10};
  double x = 0, lowest = 1;
  for (const SceneFacts& scene : input.facts) {
    if (scene.tier.empty() || !(scene.motion > 0)) continue;
    f.categories.emplace_back(x, scene.scene);
    // side by side, so that equal errors stay apart
    const double apart = 0.7 / static_cast<double>(std::max<size_t>(1, scene.methods.size()));
    double shift = -0.35;
    for (const MethodFacts& m : scene.methods) {
      auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == m.method; });
      if (curve == f.curves.end())
        curve = f.curves.insert(f.curves.end(), {m.method, style_of(m.method), {}, false, true});
      if (m.ok() && m.error) {
        const double y = std::max(*m.error, scene.bar) / scene.motion;
        curve->points.emplace_back(x + shift, y);
        lowest = std::min(lowest, y);
      } else if (m.supported() && !m.ok()) {
        f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), x + shift, 3});
      }
      shift += apart;
    }
    x += 1;
  }
  if (f.categories.empty()) return {};
  f.x.high = x - 0.4;
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  f.caption = "All scenes with a known truth; errors below a truth's error bar are drawn at the bar; commit " +
              input.commit + ".";
  f.finding = fmt::format("Error of {} methods on {} scenes in parts of the motion; runs that failed: {}.",
                          f.curves.size(), f.categories.size(), f.failures.size());
  return {{"", std::move(f)}};
}

}  // namespace crosscheck
