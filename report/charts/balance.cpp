// Where energy does not add up; on a sphere, what contact took away.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/charts.h"
#include "report/findings_text.h"

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
  constexpr double top = 3;
  double lowest = 1;
  bool above = false;
  for (const MethodFacts& m : facts.methods) {
    if (!m.supported()) continue;
    Curve curve{m.method, style_of(m.method), {}};
    for (const auto& [t, error] : points_of(table, m.method, "balance error", false)) {
      const double y = std::abs(error) / scale;
      above |= y >= top;
      if (y <= 1e-16 || y >= top) continue;
      curve.points.emplace_back(t, y);
      lowest = std::min(lowest, y);
    }
    if (!m.ok()) f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), m.end, top});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  f.tier = "exact (what is gained, lost and turned over adds up to zero), to the rounding of the sums";
  f.finding =
      "Kinetic, elastic and gravitational energy plus what drag and dashpots took, less what wind and moved pins gave: "
      "its change should be zero.";
  if (above) f.caption = fmt::format(" Not drawn: changes of more than {} times the energy turned over.", top);
  return f;
}

/// How far a curve falls below what it had reached.
double largest_fall(const std::vector<std::pair<double, double>>& points) {
  double top = -INFINITY, fall = 0;
  for (const auto& [t, y] : points) top = std::max(top, y), fall = std::max(fall, top - y);
  return fall;
}

Figure contact_figure(const Scene& scene, const SceneFacts& facts, const Table& table) {
  Figure f;
  f.name = scene.name + "-energy";
  f.title = scene.name + ": energy lost in contact";
  f.x = {"t / s", false, 0.0, scene.duration};
  f.tier =
      "another engine: how much a contact takes is not known otherwise, but that friction and inelastic contact of a "
      "still ball take and never give";
  f.y = {"energy lost in contact / J", false, std::nullopt, std::nullopt};
  std::vector<std::string> guessed, left_out, gave;
  for (const MethodFacts& m : facts.methods) {
    if (!m.supported()) continue;
    // the sticky sphere takes all motion of what touches it, which would dwarf the others' losses
    if (!m.ok() || m.method.ends_with("+sticky")) {
      left_out.push_back(m.ok() ? m.method + " (it takes all motion of what touches)"
                                : fmt::format("{} ({} at {:.3g} s)", m.method, m.failure(), m.end));
      continue;
    }
    const bool inferred = !m.method.starts_with("mysim/");
    Curve curve{m.method + (inferred ? " (inferred)" : ""), style_of(m.method),
                points_of(table, m.method, "contact loss", false)};
    if (curve.points.empty()) continue;
    if (inferred) guessed.push_back(m.method);
    if (const double given = largest_fall(curve.points); given > 0.01 * curve.points.back().second)
      gave.push_back(fmt::format("{} ({} J)", m.method, nice(given)));
    f.curves.push_back(std::move(curve));
  }
  f.finding = "What friction and impacts took, less what moving balls gave; what rests takes nothing.";
  if (!guessed.empty())
    f.finding +=
        fmt::format(" {} {} not tell it: it is inferred as what is missing from the balance, so no closure is claimed.",
                    joined(guessed), guessed.size() == 1 ? "does" : "do");
  if (!gave.empty())
    f.finding += fmt::format(" A curve that falls is contact that gives, which a still ball cannot: {}.", joined(gave));
  if (!left_out.empty()) f.caption = fmt::format(" Not drawn: {}.", joined(left_out));
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
    // after it: what is not drawn
    f.caption = caption_of(scene, input.commit) + f.caption;
    if (!f.curves.empty() || !f.failures.empty()) charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
