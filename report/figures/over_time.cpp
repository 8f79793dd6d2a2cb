// Charts of one scene over time: error, differences between engines, contact quantities, energy balance.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/engines.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

std::vector<Chart> error_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const SceneData& facts = input.facts[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (facts.tier.empty() || !(facts.motion > 0) || !table) continue;
    Figure f;
    f.name = scene.name + "-error";
    f.title = scene.name + ": error against the truth";
    f.caption = caption_of(scene, input.commit);
    f.tier = tier_of(facts);
    const double end = facts.truth_until.value_or(scene.duration);
    f.x = {"t / s", false, 0.0, end};
    const double top = 10 * facts.motion;
    f.y = {"RMS position error / m", true, std::max(facts.error_bar, 1e-16) / 3, top};
    std::vector<std::string> failed, cut;
    for (const MethodData& m : facts.methods) {
      if (!m.supported()) continue;
      Curve curve{m.method, style_of(m.method), {}};
      bool above = false;
      for (const auto& [t, error] : points_of(*table, m.method, "error", true)) {
        above |= error >= top;
        if (error < top)
          curve.points.emplace_back(t, std::max(error, facts.error_bar));  // errors below the bar are not known
      }
      if (above) cut.push_back(m.method);
      if (!m.ok()) {
        if (m.end <= end)
          f.failures.push_back({m.method + ": " + m.failure(), style_of(m.method), m.end,
                                curve.points.empty() ? top / 3 : std::min(top / 3, curve.points.back().second * 3)});
        failed.push_back(m.method);
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    f.floor = {"error bar of the truth", facts.error_bar};
    f.finding = fmt::format("Errors of {} methods over {:.3g} s{}.", f.curves.size(), end,
                            failed.empty() ? "" : fmt::format("; failed: {}", failed.size()));
    if (!cut.empty())
      f.caption += fmt::format(" Not drawn: errors above ten times the motion ({}), which {} {}.", nice_length(top),
                               joined(cut), cut.size() == 1 ? "has" : "have");
    if (f.curves.empty() && f.failures.empty()) continue;
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

std::vector<Chart> agreement_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const SceneData& facts = input.facts[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (!table) continue;
    Figure f;
    f.name = scene.name + "-agreement";
    f.title = scene.name + ": difference from mysim/symplectic-euler";
    f.caption = caption_of(scene, input.commit);
    f.tier = another_engine(facts);
    f.x = {"t / s", false, 0.0, scene.duration};
    f.y = {"RMS position difference / m", true, 1e-17,
           std::nullopt};  // the least difference that is more than round-off
    for (const MethodData& m : facts.methods) {
      if (!m.ok() || family_of(m.method).is_subject()) continue;
      Curve curve{m.method, style_of(m.method), points_of(*table, m.method, "difference", true)};
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    if (f.curves.empty()) continue;
    if (scene.window < scene.duration) f.window = {scene.window, "end of pointwise comparison"};
    for (const MethodFamily* peer : default_peers()) {
      const MethodData* its = facts.find(std::string(peer->representative));
      if (!its || !its->difference) continue;
      f.finding += fmt::format("{}{} stays within {} of mysim until {:.3g} s.", f.finding.empty() ? "" : " ",
                               peer->representative_title.empty() ? peer->representative : peer->representative_title,
                               nice_length(*its->difference), scene.window);
    }
    if (f.finding.empty()) f.finding = "Differences from mysim over time.";
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

namespace {

struct Quantity {
  const char* column;
  const char* name;
  const char* title;
  const char* label;
  double factor;  // from SI to the label's unit
  bool logarithmic;
  const char* finding;
  const char* tier;  // null: another engine
};

constexpr Quantity quantities[] = {
    {"difference from converged contact", "converged", "difference from the converged in-house contact rule",
     "RMS position difference / mm", 1e3, true,
     "How far each method is from what the in-house contact rule converges to in the step. Other rules converge to "
     "something else: these are differences, no errors.",
     "what the in-house contact rule converges to in the step"},
    {"difference of centres", "centres", "distance of the centre of mass from mysim/symplectic-euler",
     "distance of centres of mass / mm", 1e3, true, "How far the centres of mass of the engines are apart over time.",
     nullptr},
    {"clearance", "clearance", "smallest distance from the contact surface", "clearance / mm", 1e3, false,
     "How far the lowest particle stays off the contact surface, or sinks into it.",
     "exact (zero where it touches), from each method's own positions"},
    {"creep", "creep", "mean sliding speed of the touching particles", "sliding speed / (mm/s)", 1e3, true,
     "How fast the touching particles slide, and whether they come to rest.",
     "another engine; exact where all must rest: zero"},
};

}  // namespace

std::vector<Chart> contact_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const Table* table = input.result.table(scene.name + "-engines");
    if (!input.facts[i].touched() || !table) continue;
    for (const Quantity& q : quantities) {
      Figure f;
      f.name = scene.name + "-" + q.name;
      f.title = scene.name + ": " + q.title;
      f.caption = caption_of(scene, input.commit);
      f.tier = q.tier ? q.tier : "another engine, so that these are differences and no errors";
      f.finding = q.finding;
      f.x = {"t / s", false, 0.0, scene.duration};
      f.y = {q.label, q.logarithmic, std::nullopt, std::nullopt};
      for (const MethodData& m : input.facts[i].methods) {
        if (!m.ok()) continue;
        Curve curve{m.method, style_of(m.method), points_of(*table, m.method, q.column, q.logarithmic)};
        for (auto& point : curve.points) point.second *= q.factor;
        // a falling cloth is not shown
        if (std::string(q.column) == "clearance")
          std::erase_if(curve.points, [](const auto& p) { return p.second > 1; });
        if (!curve.points.empty()) f.curves.push_back(std::move(curve));
      }
      if (!f.curves.empty() && std::string(q.column) == "difference from converged contact") {
        const SceneData& facts = input.facts[i];
        f.x.high = *facts.contact_until;
        f.floor = {"error bar of the converged contact rule", facts.error_bar * q.factor};
        f.tier += fmt::format(", known until {:.3g} s to {} ({})", *facts.contact_until, nice_length(facts.error_bar),
                              facts.truth);
      }
      // curves that are zero throughout are left to the text
      const bool flat = std::ranges::all_of(f.curves, [](const Curve& c) {
        return std::ranges::all_of(c.points, [](const auto& p) { return std::abs(p.second) < 1e-9; });
      });
      if (!flat) charts.push_back({scene.name, std::move(f)});
    }
  }
  return charts;
}

namespace {

/// Largest energy turned over by any method that held, J: the scale of the balance error.
double turned_over(const std::vector<EngineEnergyRow>& rows, const std::string& scene) {
  double most = 0;
  for (const EngineEnergyRow& row : rows)
    if (row.scene == scene && row.verdict == Verdict::ok) most = std::max(most, row.turned_over);
  return most;
}

Figure balance_figure(const Scene& scene, const SceneData& facts, const Table& table, double scale) {
  Figure f;
  f.name = scene.name + "-energy";
  f.title = scene.name + ": relative energy residual";
  f.x = {"t / s", false, 0.0, scene.duration};
  f.y = {"relative energy residual", true, 1e-16, 10};
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
  f.tier = "exact (what is gained, lost and turned over adds up to zero), to the rounding of the sums";
  f.finding =
      "Kinetic, elastic and gravitational energy plus what drag and dashpots took, less what wind and moved pins gave: "
      "its change should be zero.";
  if (above) f.caption = fmt::format(" Not drawn: changes of more than {} times the energy turned over.", top);
  return f;
}

/// The largest fall of a curve below its earlier maximum.
double largest_fall(const std::vector<std::pair<double, double>>& points) {
  double top = -INFINITY, fall = 0;
  for (const auto& [t, y] : points) top = std::max(top, y), fall = std::max(fall, top - y);
  return fall;
}

Figure contact_figure(const Scene& scene, const SceneData& facts, const Table& table,
                      const std::vector<EngineEnergyRow>& energies) {
  Figure f;
  f.name = scene.name + "-energy";
  f.title = scene.name + ": energy dissipated in contact";
  f.x = {"t / s", false, 0.0, scene.duration};
  const auto known = std::ranges::find_if(
      energies, [&](const EngineEnergyRow& row) { return row.scene == scene.name && row.contact_in_truth; });
  f.tier = known == energies.end() ? "another engine; contact with a still ball takes and never gives"
                                   : fmt::format("converged until {:.3g} s: {:.5g} ± {:.1g} J; later another engine",
                                                 known->contact_until.value_or(0), *known->contact_in_truth,
                                                 known->contact_bar.value_or(0));
  f.y = {"energy dissipated in contact / J", false, std::nullopt, std::nullopt};
  std::vector<std::string> guessed, left_out, gave;
  for (const MethodData& m : facts.methods) {
    if (!m.supported()) continue;
    // the sticky sphere takes all motion of what touches it, which would dwarf the others' losses
    if (!m.ok() || m.method.ends_with("+sticky")) {
      left_out.push_back(m.ok() ? m.method + " (it takes all motion of what touches)"
                                : fmt::format("{} ({} at {:.3g} s)", m.method, m.failure(), m.end));
      continue;
    }
    const bool inferred = !family_of(m.method).is_subject();
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
  const auto energies = rows_of<EngineEnergyRow>(input.result);
  for (size_t i = 0; i < input.scenes.size(); ++i) {
    const Scene& scene = input.scenes[i];
    const Table* table = input.result.table(scene.name + "-energy");
    const double scale = turned_over(energies, scene.name);
    if (!table || !(scale > 0)) continue;
    Figure f = input.facts[i].touched() ? contact_figure(scene, input.facts[i], *table, energies)
                                        : balance_figure(scene, input.facts[i], *table, scale);
    // the caption ends with what is not drawn
    f.caption = caption_of(scene, input.commit) + f.caption;
    if (!f.curves.empty() || !f.failures.empty()) charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
