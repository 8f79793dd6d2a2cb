#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/engines.h"
#include "reference/engines/engines.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

using Make = std::vector<Chart> (*)(const ChartInput& input, const Scene& scene, const SceneData& facts,
                                    const Table& table);

/// Charts of all scenes that have a table whose name ends with `ending`.
std::vector<Chart> of_all_scenes(const ChartInput& input, const char* ending, Make make) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    if (const Table* table = input.result.table(scene.name + ending))
      for (Chart& chart : make(input, scene, input.facts[i], *table)) {
        chart.scene = scene.name;
        charts.push_back(std::move(chart));
      }
  }
  return charts;
}

std::vector<Chart> error_charts_of(const ChartInput& input, const Scene& scene, const SceneData& facts,
                                   const Table& table) {
  if (facts.tier.empty() || !(facts.motion > 0)) return {};
  Figure f;
  f.caption = caption_of(scene, input.commit);
  f.tier = tier_of(facts);
  const double end = facts.truth_until.value_or(scene.duration), top = 10 * facts.motion;
  f.x.low = 0, f.x.high = end;
  f.y.low = std::max(facts.error_bar, 1e-16) / 3, f.y.high = top;
  std::vector<std::string> cut;
  size_t failed = 0;
  for (const MethodData& m : facts.methods) {
    if (!m.supported()) continue;
    Curve curve{m.method, style_of(m.method), {}};
    bool above = false;
    for (const auto& [t, error] : points_of(table, m.method, "error", true)) {
      above |= error >= top;
      if (error < top)
        curve.points.emplace_back(t, std::max(error, facts.error_bar));  // errors below the bar are unknown
    }
    if (above) cut.push_back(m.method);
    failed += !m.ok();
    if (!m.ok() && m.end <= end)
      f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), m.end,
                            curve.points.empty() ? top / 3 : std::min(top / 3, curve.points.back().second * 3)});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.floor = {"error bar of the reference", facts.error_bar};
  f.finding = fmt::format("Errors of {} methods over {:.3g} s{}.", f.curves.size(), end,
                          failed == 0 ? "" : fmt::format("; failed: {}", failed));
  if (!cut.empty())
    f.caption += fmt::format(" Not drawn: errors above ten times the motion ({}), which {} {}.", nice_length(top),
                             joined(cut), cut.size() == 1 ? "has" : "have");
  if (f.curves.empty() && f.failures.empty()) return {};
  return {described("{scene}-error", std::move(f), "scene"_a = scene.name)};
}

std::vector<Chart> agreement_charts_of(const ChartInput& input, const Scene& scene, const SceneData& facts,
                                       const Table& table) {
  Figure f;
  f.caption = caption_of(scene, input.commit);
  f.tier = another_engine(facts);
  f.x.low = 0, f.x.high = scene.duration;
  f.y.low = 1e-17;  // lower values are round-off
  for (const MethodData& m : facts.methods) {
    if (!m.ok() || family_of(m.method).is_subject()) continue;
    Curve curve{m.method, style_of(m.method), points_of(table, m.method, "difference", true)};
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  if (f.curves.empty()) return {};
  if (scene.window < scene.duration) f.window = {scene.window, "end of pointwise comparison"};
  for (const MethodFamily* peer : default_peers()) {
    const MethodData* its = facts.find(std::string(peer->representative));
    if (!its || !its->difference) continue;
    f.finding += fmt::format("{}{} stays within {} of mysim until {:.3g} s.", f.finding.empty() ? "" : " ",
                             peer->representative_title.empty() ? peer->representative : peer->representative_title,
                             nice_length(*its->difference), scene.window);
  }
  if (f.finding.empty()) f.finding = "Differences from mysim over time.";
  return {described("{scene}-agreement", std::move(f), "scene"_a = scene.name)};
}

struct Quantity {
  const char *column, *name;
  double factor;  // converts from SI to the label's unit
  bool positive;
};
constexpr Quantity quantities[] = {{"difference from converged contact", "{scene}-converged", 1e3, true},
                                   {"difference of centres", "{scene}-centres", 1e3, true},
                                   {"clearance", "{scene}-clearance", 1e3, false},
                                   {"creep", "{scene}-creep", 1e3, true}};

std::vector<Chart> contact_charts_of(const ChartInput& input, const Scene& scene, const SceneData& facts,
                                     const Table& table) {
  std::vector<Chart> charts;
  if (!facts.touched()) return {};
  for (const Quantity& q : quantities) {
    Figure f;
    f.caption = caption_of(scene, input.commit);
    f.x.low = 0, f.x.high = scene.duration;
    for (const MethodData& m : facts.methods) {
      if (!m.ok()) continue;
      Curve curve{m.method, style_of(m.method), points_of(table, m.method, q.column, q.positive)};
      for (auto& point : curve.points) point.second *= q.factor;
      // omit values of cloths that are still falling
      if (&q == &quantities[2]) std::erase_if(curve.points, [](const auto& p) { return p.second > 1; });
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    if (!f.curves.empty() && &q == &quantities[0]) {
      f.x.high = *facts.contact_until;
      f.floor = {"error bar of the converged contact rule", facts.error_bar * q.factor};
    }
    // omit the chart if there are no curves, or if all of them are zero
    const bool flat = std::ranges::all_of(f.curves, [](const Curve& c) {
      return std::ranges::all_of(c.points, [](const auto& p) { return std::abs(p.second) < 1e-9; });
    });
    if (!flat)
      charts.push_back(described(q.name, std::move(f), "scene"_a = scene.name,
                                 "until"_a = facts.contact_until.value_or(0), "bar"_a = nice_length(facts.error_bar),
                                 "truth"_a = facts.truth));
  }

  return charts;
}

/// Largest energy (J) exchanged by any completed method; it is the scale of the balance error.
double turned_over(const std::vector<EngineEnergyRow>& rows, const std::string& scene) {
  double most = 0;
  for (const EngineEnergyRow& row : rows)
    if (row.scene == scene && row.verdict == Verdict::ok) most = std::max(most, row.turned_over);
  return most;
}

Figure balance_figure(const SceneData& facts, const Table& table, double scale) {
  Figure f;
  f.y.high = 10;
  constexpr double top = 3;
  double lowest = 1;
  bool above = false;
  for (const MethodData& m : facts.methods) {
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
  if (above) f.caption = fmt::format(" Not drawn: changes of more than {} times the energy exchanged.", top);
  return f;
}

double largest_fall(const std::vector<std::pair<double, double>>& points) {
  double top = -INFINITY, fall = 0;
  for (const auto& [t, y] : points) top = std::max(top, y), fall = std::max(fall, top - y);
  return fall;
}

Figure contact_figure(const Scene& scene, const SceneData& facts, const Table& table,
                      const std::vector<EngineEnergyRow>& energies) {
  Figure f;
  const auto known = std::ranges::find_if(
      energies, [&](const EngineEnergyRow& row) { return row.scene == scene.name && row.contact_in_truth; });
  f.tier = known == energies.end() ? "another engine; contact with a ball at rest takes energy and never supplies it"
                                   : fmt::format("converged until {:.3g} s: {:.5g} ± {:.1g} J; later another engine",
                                                 known->contact_until.value_or(0), *known->contact_in_truth,
                                                 known->contact_bar.value_or(0));
  std::vector<std::string> guessed, left_out, gave;
  for (const MethodData& m : facts.methods) {
    if (!m.supported()) continue;
    // omit the sticky sphere: it stops all particles in contact, and its losses would dwarf all others
    if (!m.ok() || m.method.ends_with("+sticky")) {
      left_out.push_back(m.ok() ? m.method + " (it stops everything that touches)"
                                : fmt::format("{} ({} at {:.3g} s)", without_folders(m.method), m.failure(), m.end));
      continue;
    }
    const bool inferred = !family_of(m.method).is_subject();
    Curve curve{m.method + (inferred ? " (inferred)" : ""), style_of(m.method),
                points_of(table, m.method, "contact loss", false)};
    if (curve.points.empty()) continue;
    if (inferred) guessed.push_back(m.method);
    if (const double given = largest_fall(curve.points); given > 0.01 * curve.points.back().second)
      gave.push_back(fmt::format("{} ({} J)", without_folders(m.method), nice(given)));
    f.curves.push_back(std::move(curve));
  }
  f.finding = "Energy taken by friction and impacts, minus energy supplied by moving balls; bodies at rest take none.";
  if (!guessed.empty())
    f.finding += fmt::format(" {} {} not report it: it is inferred from the balance, so closure is not claimed.",
                             joined(guessed), guessed.size() == 1 ? "does" : "do");
  if (!gave.empty())
    f.finding += fmt::format(" A falling curve means that contact supplies energy, which a ball at rest cannot: {}.",
                             joined(gave));
  if (!left_out.empty()) f.caption = fmt::format(" Not drawn: {}.", joined(left_out));
  return f;
}

std::vector<Chart> balance_charts_of(const ChartInput& input, const Scene& scene, const SceneData& facts,
                                     const Table& table) {
  const auto energies = rows_of<EngineEnergyRow>(input.result);

  const double scale = turned_over(energies, scene.name);
  if (!(scale > 0)) return {};
  const bool touched = facts.touched();
  Figure f = touched ? contact_figure(scene, facts, table, energies) : balance_figure(facts, table, scale);
  if (f.curves.empty() && f.failures.empty()) return {};
  f.x.low = 0, f.x.high = scene.duration;
  f.caption = caption_of(scene, input.commit) + f.caption;
  f.name = scene.name + "-energy";
  return {described(touched ? "contact {scene}-energy" : "{scene}-energy", std::move(f), "scene"_a = scene.name)};
}

}  // namespace

std::vector<Chart> error_charts(const ChartInput& input) { return of_all_scenes(input, "-engines", error_charts_of); }
std::vector<Chart> agreement_charts(const ChartInput& input) {
  return of_all_scenes(input, "-engines", agreement_charts_of);
}
std::vector<Chart> contact_charts(const ChartInput& input) {
  return of_all_scenes(input, "-engines", contact_charts_of);
}
std::vector<Chart> balance_charts(const ChartInput& input) {
  return of_all_scenes(input, "-energy", balance_charts_of);
}

}  // namespace crosscheck
