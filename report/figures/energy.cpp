#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "experiments/tables/energy.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Colours differ pairwise by at least 8 in lightness (CIE L*), so that a grey print distinguishes them.
std::vector<StackedBars::Part> parts_for(size_t bars) {
  std::vector<StackedBars::Part> parts = {{"drag", "#005F95", false, {}},
                                          {"dashpots", "#71BBEB", false, {}},
                                          {"contact", "#BA5100", false, {}},
                                          {"contact (inferred)", "#BA5100", true, {}},
                                          {"kinetic+elastic (end)", "#CFECE0", false, {}},
                                          {"energy residual", "#CF86AE", false, {}},
                                          {"gravity", "#868686", false, {}},
                                          {"kinetic+elastic (start)", "#313131", false, {}},
                                          {"wind", "#F4C664", false, {}},
                                          {"moved pins", "#703600", false, {}}};
  for (StackedBars::Part& part : parts) part.height.assign(bars, 0);
  return parts;
}

/// "100 s, up to 100000 steps of 0.001 s", for the longest run.
std::string length_text(const std::vector<EnergyRow>& runs) {
  const EnergyRow* longest = nullptr;
  for (const EnergyRow& run : runs)
    if (!longest || (run.end >= longest->end && run.steps >= longest->steps)) longest = &run;
  return fmt::format("{:.4g} s, up to {} steps of {}", longest->end, longest->steps, step_text(longest->step));
}

/// Chart of the energy budget; nullopt if energy is neither dissipated nor supplied.
std::optional<Chart> budget_chart(const std::vector<EnergyRow>& runs, const std::string& commit) {
  const std::string& scene = runs[0].scene;
  StackedBars bars;
  std::vector<std::array<double, 10>> heights;  // one row per run, ordered like parts_for()
  std::string failed;
  bars.finding = "Energy supplied to each run, left of zero, and its distribution, right of zero.";
  bool inferred = false;
  for (const EnergyRow& run : runs) {
    if (!run.kinetic) continue;
    if (run.undamped) return std::nullopt;
    if (run.verdict != Verdict::ok) {
      failed += fmt::format(" {} is not shown: {} at {:.3g} s.", name_in_sentence(run.method),
                            failure_class(run.verdict), run.end);
      continue;
    }
    bars.names.push_back(run.method);
    inferred |= run.contact_inferred;
    const auto of = [](const OptionalNumber& energy) { return energy.value_or(0); };
    heights.push_back({of(run.drag), of(run.dashpots), run.contact_inferred ? 0 : of(run.contact),
                       run.contact_inferred ? of(run.contact) : 0, of(run.kinetic) + of(run.elastic), -of(run.residual),
                       -of(run.gravity), -of(run.kinetic_at_start) - of(run.elastic_at_start), -of(run.wind),
                       -of(run.pins)});
  }
  bars.parts = parts_for(heights.size());
  bool any = false;
  for (size_t b = 0; b < heights.size(); ++b)
    for (size_t p = 0; p < bars.parts.size(); ++p) bars.parts[p].height[b] = heights[b][p], any |= heights[b][p] != 0;
  if (!any) return std::nullopt;  // at rest
  if (inferred)
    bars.finding += " Hatched: inferred for engines that do not report their impulses; closure is not claimed.";
  return described("{scene}-energy-budget", std::move(bars), "scene"_a = scene, "length"_a = length_text(runs),
                   "about"_a = scene == "all-at-once" ? filled_text(scene, "text") : "", "failed"_a = failed,
                   "commit"_a = commit);
}

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// Energy residual over time on an undamped scene.
Chart drift_chart(const std::vector<EnergyRow>& runs, const Table& ledger, const std::string& commit) {
  Figure f;
  f.y.high = 3;
  double lowest = 1;
  std::vector<std::string> absent;                                        // runs that have no curve, with the reason
  std::vector<std::pair<std::string, std::vector<std::string>>> classes;  // class of the residual, and its methods
  for (const EnergyRow& run : runs) {
    const std::string name = name_in_sentence(run.method);
    const double turned = run.turned_over.value_or(0);
    const std::string why = run.verdict == Verdict::unsupported        ? "cannot: " + run.reason
                            : !run.closure_claimed || !run.turned_over ? "no closure claimed"
                            : !(turned > 0)                            ? "nothing moves"
                                                                       : "";
    if (!why.empty()) {
      absent.push_back(fmt::format("{} ({})", name, why));
      continue;
    }
    const std::string what = residual_class(run);
    auto entry = std::ranges::find(classes, what, [](const auto& each) { return each.first; });
    if (entry == classes.end()) entry = classes.insert(classes.end(), {what, {}});
    entry->second.push_back(name);
    Curve curve{run.method, style_of(run.method), {}};
    for (const auto& [t, worst] : points_of(ledger, run.method, "largest residual", true))
      if (const double y = worst / turned; t > 0 && y > 1e-17 && y < 3) {
        curve.points.emplace_back(t, y);
        lowest = std::min(lowest, y);
      }
    if (run.verdict != Verdict::ok) f.failures.push_back({run.method + ": " + what, style_of(run.method), run.end, 1});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  for (const auto& [what, methods] : classes)
    f.finding += fmt::format("{}{}: {}.", f.finding.empty() ? "" : " ", capital(what), joined(methods));
  // scenes at rest have no curves, and neither have engines that do not close the budget
  if (f.curves.empty()) f.failures.clear();
  return described("{scene}-energy-drift", std::move(f), "scene"_a = runs[0].scene, "length"_a = length_text(runs),
                   "absent"_a = absent.empty() ? "" : fmt::format(" Not drawn: {}.", joined(absent)),
                   "commit"_a = commit);
}

Chart damping_chart(const std::vector<DampingRow>& rows, const std::string& commit) {
  Figure f;
  f.y.low = 1e-9, f.y.high = 3;
  constexpr double omega = 10;  // rad/s, frequency of the oscillator in the table
  double worst = 0;
  size_t checked = 0;
  std::vector<std::string> damped;  // methods that damp in theory, in the order of the table
  std::vector<std::pair<double, double>> implicit_euler, rk4;
  for (int i = 0; i <= 240; ++i) {
    const double y = 0.01 * std::pow(500, i / 240.);
    implicit_euler.emplace_back(y, std::log1p(y * y) / y);
    const double lost = std::pow(y, 6) / 72 - std::pow(y, 8) / 576;
    if (lost > 0 && lost < 1 && y < 2.7) rk4.emplace_back(y, -std::log1p(-lost) / y);
  }
  std::erase_if(rk4, [](const auto& p) { return p.second < 1e-9; });
  f.curves.push_back({"backward Euler, theory", {"#555555", "1", -1}, implicit_euler});
  f.curves.push_back({"rk4, theory", {"#009E73", "(6,3)", -1}, rk4});
  for (const std::string& method : distinct(rows, &DampingRow::method)) {
    Curve curve{method, style_of(method), {}, false, true};
    for (const DampingRow& row : rows | with(&DampingRow::method, method)) {
      if (!row.equivalent_drag) continue;
      const double rate = *row.equivalent_drag, theory = row.by_theory.value_or(0);
      if (theory > 0) {
        worst = std::max(worst, std::abs(rate / theory - 1)), ++checked;
        if (damped.empty() || damped.back() != method) damped.push_back(method);
      }
      // without damping in theory, the measured slope is noise
      if (row.by_theory ? theory > 0 && rate > 0 : rate > 1e-3) curve.points.emplace_back(row.h_omega, rate / omega);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding = checked == 0 ? "In theory none of these methods damps an oscillation."
                           : fmt::format(
                                 "The energy taken by {} from one spring deviates from the closed form by at most {}, "
                                 "in {} measurements.",
                                 joined(damped), percent(worst, 1), checked);
  return described("energy-damping", std::move(f), "commit"_a = commit);
}

}  // namespace

std::vector<Chart> energy_charts(const ChartInput& input) {
  std::vector<Chart> charts, drifts;
  const auto rows = rows_of<EnergyRow>(input.result);
  for (const std::string& scene : distinct(rows, &EnergyRow::scene)) {
    std::vector<EnergyRow> runs;
    std::ranges::copy(rows | with(&EnergyRow::scene, scene), std::back_inserter(runs));
    if (auto chart = budget_chart(runs, input.commit)) charts.push_back(std::move(*chart));
    if (const Table* ledger = input.result.table(scene + "-ledger");
        ledger && std::ranges::any_of(runs, &EnergyRow::undamped))
      drifts.push_back(drift_chart(runs, *ledger, input.commit));
  }
  if (const auto drawn = std::ranges::find_if(drifts, figure_info); drawn != drifts.end()) drawn->shown = true;
  std::ranges::move(drifts, std::back_inserter(charts));
  if (const auto damping = rows_of<DampingRow>(input.result); !damping.empty())
    charts.push_back(damping_chart(damping, input.commit));
  return charts;
}

}  // namespace crosscheck
