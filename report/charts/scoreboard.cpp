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
    double shift = -0.3;  // side by side, so that equal errors stay apart
    for (const MethodFacts& m : scene.methods) {
      auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == m.method; });
      if (curve == f.curves.end())
        curve = f.curves.insert(f.curves.end(), {m.method, style_of(m.method), {}, false, true});
      if (m.ok() && m.error) {
        const double y = std::max(*m.error, scene.bar) / scene.motion;
        curve->points.emplace_back(x + shift, y);
        lowest = std::min(lowest, y);
      } else if (m.supported() && !m.ok()) {
        f.failures.push_back({m.method + ": blew up", style_of(m.method), x + shift, 3});
      }
      shift += 0.1;
    }
    x += 1;
  }
  if (f.categories.empty()) return {};
  f.x.high = x - 0.4;
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  f.caption = "All scenes with a known truth; errors below a truth's error bar are drawn at the bar; commit " +
              input.commit + ".";
  f.finding = fmt::format("Error of {} methods on {} scenes in parts of the motion; runs that blew up: {}.",
                          f.curves.size(), f.categories.size(), f.failures.size());
  return {{"", std::move(f)}};
}

}  // namespace crosscheck
