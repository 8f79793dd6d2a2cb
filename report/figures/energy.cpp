// Experiment `energy`: budget of each run, drift of the energy residual, numerical damping.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Nine colours, each at least 8 in lightness (CIE L*) from every other, so that a grey print tells them apart.
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

/// The longest time and its steps, of any run of the scene: "100 s, up to 100000 steps of 0.001 s".
std::string length_text(const Table& table, const std::string& scene) {
  double end = 0, step = 0;
  long steps = 0;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "scene") == scene && number_at(table, i, "end", 0) >= end)
      if (const long n = std::get<long>(table.at(i, "steps")); n >= steps)
        steps = n, step = number_at(table, i, "step", 0), end = number_at(table, i, "end", 0);
  return fmt::format("{:.4g} s, up to {} steps of {}", end, steps, step_text(step));
}

/// The energy budget of a scene with dissipation or supplied energy; empty for other scenes.
std::optional<Chart> budget_chart(const Table& table, const std::string& scene, const std::string& commit) {
  std::vector<size_t> shown;
  std::string failed;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || !number_at(table, i, "kinetic")) continue;
    if (flag_at(table, i, "undamped")) return std::nullopt;
    if (text_at(table, i, "verdict") == "ok")
      shown.push_back(i);
    else
      failed += fmt::format(" {} is not shown: {} at {:.3g} s.", name_in_sentence(text_at(table, i, "method")),
                            failure_class(text_at(table, i, "verdict")), number_at(table, i, "end", 0));
  }
  if (shown.empty()) return std::nullopt;
  StackedBars bars;
  bars.name = scene + "-energy-budget";
  bars.title = scene + ": energy budget";
  bars.label = "energy / J";
  bars.parts = parts_for(shown.size());
  bool inferred = false;
  for (size_t b = 0; b < shown.size(); ++b) {
    const size_t i = shown[b];
    bars.names.push_back(text_at(table, i, "method"));
    const bool guessed = flag_at(table, i, "contact inferred");
    inferred |= guessed;
    const double contact = number_at(table, i, "contact took", 0);
    const double heights[] = {number_at(table, i, "drag took", 0),
                              number_at(table, i, "dashpots took", 0),
                              guessed ? 0 : contact,
                              guessed ? contact : 0,
                              number_at(table, i, "kinetic", 0) + number_at(table, i, "elastic", 0),
                              -number_at(table, i, "residual", 0),
                              -number_at(table, i, "gravity gave", 0),
                              -number_at(table, i, "kinetic at start", 0) - number_at(table, i, "elastic at start", 0),
                              -number_at(table, i, "wind gave", 0),
                              -number_at(table, i, "pins gave", 0)};
    for (size_t p = 0; p < bars.parts.size(); ++p) bars.parts[p].height[b] = heights[p];
  }
  const auto nothing = [](const StackedBars::Part& part) {
    return std::all_of(part.height.begin(), part.height.end(), [](double height) { return height == 0; });
  };
  if (std::all_of(bars.parts.begin(), bars.parts.end(), nothing)) return std::nullopt;  // at rest
  bars.finding = "What each run was given, left of zero, and where it went, right of it.";
  if (inferred)
    bars.finding += " Hatched: what is missing where an engine does not tell its impulses; no closure is claimed.";
  bars.tier = "exact (the sum is zero), to the rounding of the sums";
  bars.caption = fmt::format("Scene {}; {}, rules that solve a whole step at ten times that; commit {}.", scene,
                             length_text(table, scene), commit);
  const std::string about =
      scene == "all-at-once"
          ? "Everything takes or gives energy: a cloth of 5 x 5 particles, held by two moved corners, swings in gusts "
            "against a ball, with drag, springs that damp, and friction."
          : "";
  return Chart{"", std::move(bars), "energy", about + failed};
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// The residual over time on a scene that nothing damps.
Chart drift_chart(const Table& table, const Table& rows, const std::string& scene, const std::string& commit) {
  Figure f;
  f.name = scene + "-energy-drift";
  f.title = scene + ": long-time energy drift";
  f.x = {"t / s", true, std::nullopt, std::nullopt};
  f.y = {"largest relative energy residual so far", true, std::nullopt, 3.0};
  double lowest = 1;
  std::vector<std::string> absent;  // no curve, and why
  const std::vector<EnergyRow> runs = rows_of<EnergyRow>(table);
  std::vector<std::pair<std::string, std::vector<std::string>>> classes;  // class of the residual, its methods
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene) continue;
    const std::string& method = text_at(table, i, "method");
    if (text_at(table, i, "verdict") == "unsupported") {
      absent.push_back(fmt::format("{} (cannot: {})", name_in_sentence(method), text_at(table, i, "reason")));
      continue;
    }
    if (!flag_at(table, i, "closure claimed") || !number_at(table, i, "energy turned over")) {
      absent.push_back(name_in_sentence(method) + " (no closure claimed)");
      continue;
    }
    if (!(number_at(table, i, "energy turned over", 0) > 0)) {
      absent.push_back(name_in_sentence(method) + " (nothing moves)");
      continue;
    }
    const double turned = number_at(table, i, "energy turned over", 0), end = number_at(table, i, "end", 0);
    const std::string what = residual_class(runs[i]);
    auto entry = std::find_if(classes.begin(), classes.end(), [&](const auto& each) { return each.first == what; });
    if (entry == classes.end()) entry = classes.insert(classes.end(), {what, {}});
    entry->second.push_back(name_in_sentence(method));
    const bool ok = text_at(table, i, "verdict") == "ok";
    Curve curve{method, style_of(method), {}};
    for (const auto& [t, worst] : points_of(rows, method, "largest residual", true))
      if (const double y = worst / turned; t > 0 && y > 1e-17 && y < 3) {
        curve.points.emplace_back(t, y);
        lowest = std::min(lowest, y);
      }
    if (!ok) f.failures.push_back({method + ": " + what, style_of(method), end, 1});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  for (const auto& [what, methods] : classes)
    f.finding += fmt::format("{}{}: {}.", f.finding.empty() ? "" : " ", capital(what), joined(methods));
  f.tier = "exact (it is zero), to the rounding of the sums";
  f.caption = fmt::format(
      "Scene {}, undamped; {}, rules that solve a whole step at ten times that; "
      "commit {}.",
      scene, length_text(table, scene), commit);
  if (!absent.empty()) f.caption += fmt::format(" Not drawn: {}.", joined(absent));
  // nothing can be drawn of a scene at rest, or of engines that claim no closure
  Chart chart{"", std::monostate{}, "energy", f.curves.empty() ? f.caption : "", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);
  return chart;
}

/// The numerical damping of steppers.
Chart damping_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "energy-damping";
  f.title = "Numerical damping of each stepper";
  f.x = {"time step × angular frequency, h ω", true, std::nullopt, std::nullopt};
  f.y = {"equivalent drag rate / ω", true, 1e-9, 3.0};
  constexpr double omega = 10;  // rad/s, of the table's oscillator
  double worst = 0;
  size_t checked = 0;
  std::vector<std::string> damped;  // by theory, and measured
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
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, false, true};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || !number_at(table, i, "equivalent drag")) continue;
      const double rate = number_at(table, i, "equivalent drag", 0), theory = number_at(table, i, "by theory", 0),
                   size = number_at(table, i, "h omega", 0);
      if (theory > 0) {
        worst = std::max(worst, std::abs(rate / theory - 1)), ++checked;
        if (damped.empty() || damped.back() != method) damped.push_back(method);
      }
      // where theory gives zero the measured slope is noise
      if (number_at(table, i, "by theory") ? theory > 0 && rate > 0 : rate > 1e-3)
        curve.points.emplace_back(size, rate / omega);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      checked == 0
          ? "By theory none of the methods here damps an oscillation."
          : fmt::format("What {} took from one spring is off the closed form by {} at most, in {} measurements.",
                        joined(damped), percent(worst, 1), checked);
  f.tier = "exact for the discrete rule (its stability function)";
  f.caption = fmt::format(
      "1 kg on 100 N/m, ω = 10 rad/s, 1 mm; measured: slope of ln(energy) over time; symplectic "
      "rules damp nothing and are left out; commit {}.",
      commit);
  return {"", std::move(f), "energy",
          "A rule may take energy where nothing in the scene does. What it takes from an undamped oscillator is given "
          "as the drag rate that would take as much: by theory -2 ln|R(i h ω)| / h, with R the rule's stability "
          "function."};
}

}  // namespace

std::vector<Chart> energy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  bool any_shown = false;
  if (const Table* table = input.result.table("energy")) {
    for (const std::string& scene : distinct(*table, "scene"))
      if (auto chart = budget_chart(*table, scene, input.commit)) charts.push_back(std::move(*chart));
    for (const std::string& scene : distinct(*table, "scene")) {
      const Table* rows = input.result.table(scene + "-ledger");
      bool undamped = false;
      for (size_t i = 0; i < table->rows.size(); ++i)
        undamped |= text_at(*table, i, "scene") == scene && flag_at(*table, i, "undamped");
      if (undamped && rows) {
        charts.push_back(drift_chart(*table, *rows, scene, input.commit));
        charts.back().shown = !any_shown && figure_info(charts.back()), any_shown |= charts.back().shown;
      }
    }
  }
  if (const Table* table = input.result.table("energy-damping")) charts.push_back(damping_chart(*table, input.commit));
  return charts;
}

}  // namespace crosscheck
