// One look: the error of every method on every scene, in parts of the scene's motion; failed runs as crosses on top.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/charts/charts.h"
#include "report/findings_text.h"

namespace crosscheck {

std::vector<Chart> scoreboard_charts(const ChartInput& input) {
  constexpr double top = 10;
  Figure f;
  f.name = "scoreboard";
  f.title = "Error of each method at the scene's own step";
  f.x = {"", false, -0.6, std::nullopt};
  f.y = {"largest RMS error / motion of the scene", true, std::nullopt, top};
  double x = 0, lowest = 1;
  std::set<std::string> methods;
  std::vector<std::string> cut;
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
        if (y > top) cut.push_back(fmt::format("{} on {} ({})", m.method, scene.scene, nice(y)));
        curve->points.emplace_back(x + shift, std::min(y, top));
        lowest = std::min(lowest, y);
        methods.insert(m.method);
      } else if (m.supported() && !m.ok()) {
        methods.insert(m.method);
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
  if (!cut.empty()) f.caption += fmt::format(" Drawn at {} times the motion, though larger: {}.", top, joined(cut));
  f.tier = "the truth of each scene, exact or converged, as its part says";
  f.finding = fmt::format("Error of {} methods on {} scenes in parts of the motion; runs that failed: {}.",
                          methods.size(), f.categories.size(), f.failures.size());
  return {{"", std::move(f)}};
}

}  // namespace crosscheck
