// Where energy does not add up; on a sphere, what contact took away.
#include <algorithm>
#include <cmath>

#include "report/charts/charts.h"

namespace crosscheck {
namespace {

/// Largest energy turned over by any method that held, J: the scale of the balance error.
double turned_over(const Table& summary, const std::string& scene) {
  double most = 0;
  for (size_t i = 0; i < summary.rows.size(); ++i)
    if (std::get<std::string>(summary.at(i, "scene")) == scene &&
        std::get<std::string>(summary.at(i, "verdict")) == "ok")
      most = std::max(most, std::get<double>(summary.at(i, "energy turned over")));
  return most;
}

Figure balance_figure(const Scene& scene, const SceneFacts& facts, const Table& table, double scale) {
  Figure f;
  f.name = scene.name + "-energy";
  f.title = scene.name + ": energy that does not add up";
  f.x = {"t / s", false, 0.0, scene.duration};
  f.y = {"|balance error| / energy turned over", true, 1e-16, 10};
  double lowest = 1;
  for (const MethodFacts& m : facts.methods) {
    if (!m.supported()) continue;
    Curve curve{m.method, style_of(m.method), {}};
    for (const auto& [t, error] : points_of(table, m.method, "balance error", false))
      if (const double y = std::abs(error) / scale; y > 1e-16 && y < 3) {
        curve.points.emplace_back(t, y);
        lowest = std::min(lowest, y);
      }
    if (!m.ok()) f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), m.end, 3});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  f.finding =
      "Kinetic, elastic and gravitational energy plus what drag and dashpots took, less what wind and moved pins gave: "
      "its change "
      "should be zero.";
  return f;
}

Figure contact_figure(const Scene& scene, const SceneFacts& facts, const Table& table) {
  Figure f;
  f.name = scene.name + "-energy";
  f.title = scene.name + ": energy lost in contact";
  f.x = {"t / s", false, 0.0, scene.duration};
  f.y = {"energy lost in contact / J", false, std::nullopt, std::nullopt};
  for (const MethodFacts& m : facts.methods) {
    // the sticky sphere holds the cloth by a force from nowhere: its work would dwarf the others' losses
    if (!m.ok() || m.method.ends_with("+sticky")) continue;
    const bool inferred = !m.method.starts_with("mysim/");
    Curve curve{m.method + (inferred ? " (inferred)" : ""), style_of(m.method),
                points_of(table, m.method, "contact loss", false)};
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "What contact took, less what moving balls gave: mysim reports it; for Bullet it is inferred as what is missing "
      "from the balance, so no "
      "closure is claimed. Rules of first order put a resting particle too deep or too high in each step and contact "
      "corrects it: that part of their curves falls with the step.";
  return f;
}

}  // namespace

std::vector<Chart> balance_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* summary = input.result.table("engines-energy");
  for (size_t i = 0; i < input.scenes.size() && summary; ++i) {
    const Scene& scene = input.scenes[i];
    const Table* table = input.result.table(scene.name + "-energy");
    const double scale = turned_over(*summary, scene.name);
    if (!table || !(scale > 0)) continue;
    Figure f = input.facts[i].touched() ? contact_figure(scene, input.facts[i], *table)
                                        : balance_figure(scene, input.facts[i], *table, scale);
    f.caption = caption_of(scene, input.facts[i], input.commit, false);
    if (!f.curves.empty() || !f.failures.empty()) charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
