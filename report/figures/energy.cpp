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

std::vector<StackedBars::Part> parts_for(size_t bars) {
  std::vector<StackedBars::Part> parts = {{"drag", "#0072B2", false, {}},
                                          {"dashpots", "#56B4E9", false, {}},
                                          {"contact", "#D55E00", false, {}},
                                          {"contact (inferred)", "#D55E00", true, {}},
                                          {"left: motion and springs", "#009E73", false, {}},
                                          {"does not add up", "#CC79A7", false, {}},
                                          {"gravity", "#999999", false, {}},
                                          {"at the start", "#333333", false, {}},
                                          {"wind", "#E69F00", false, {}},
                                          {"moved pins", "#7A3B00", false, {}}};
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

/// StackedBars of a scene in which something takes or gives energy; empty of others.
std::optional<Chart> budget_chart(const Table& table, const std::string& scene, const std::string& commit) {
  std::vector<size_t> shown;
  std::string failed;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || !number_at(table, i, "kinetic")) continue;
    if (flag_at(table, i, "undamped")) return std::nullopt;
    if (text_at(table, i, "verdict") == "ok")
      shown.push_back(i);
    else
      failed += fmt::format(" {} is not shown: {} at {:.3g} s.", text_at(table, i, "method"),
                            failure_class(text_at(table, i, "verdict")), number_at(table, i, "end", 0));
  }
  if (shown.empty()) return std::nullopt;
  StackedBars bars;
  bars.name = scene + "-energy-budget";
  bars.title = scene + ": where energy came from and went";
  bars.label = "energy / J (left of zero: came in)";
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
    bars.finding +=
        " Hatched: an engine that does not tell its impulses; what is missing is called contact, and no closure is "
        "claimed.";
  bars.tier = "exact (the sum is zero), to the rounding of the sums";
  bars.caption = fmt::format("Scene {}; {}, rules that solve a whole step at ten times that; commit {}.", scene,
                             length_text(table, scene), commit);
  const std::string about =
      scene == "all-at-once"
          ? "One small scene with everything that takes or gives energy: a cloth of 5 x 5 particles, held by two moved "
            "corners, swings in gusts against a ball, with drag, springs that damp, and friction."
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
  f.title = scene + ": energy that does not add up, over a long time";
  f.x = {"t / s", true, std::nullopt, std::nullopt};
  f.y = {"largest |residual| so far / energy turned over", true, std::nullopt, 3.0};
  PageTable page{fmt::format("{}: what becomes of the energy in {}", scene, length_text(table, scene)),
                 {"method", "step", "residual", "largest / energy turned over",
                  "largest / that of the first tenth (10: grows like time)", "equivalent drag / (1/s)"},
                 {}};
  double lowest = 1;
  std::vector<std::pair<std::string, std::vector<std::string>>> fates;  // what becomes of it, and by which methods
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene) continue;
    const std::string& method = text_at(table, i, "method");
    if (text_at(table, i, "verdict") == "unsupported") {
      page.rows.push_back({method, "", "cannot: " + text_at(table, i, "reason"), "", "", ""});
      continue;
    }
    if (!flag_at(table, i, "closure claimed") || !number_at(table, i, "energy turned over")) {
      page.rows.push_back({method, step_text(number_at(table, i, "step", 0)), "no closure claimed", "", "", ""});
      continue;
    }
    if (!(number_at(table, i, "energy turned over", 0) > 0)) {
      page.rows.push_back({method, step_text(number_at(table, i, "step", 0)), "nothing moves", "", "", ""});
      continue;
    }
    const bool symplectic = flag_at(table, i, "symplectic");
    const std::string title = method + (symplectic ? " (symplectic)" : "");
    const double turned = number_at(table, i, "energy turned over", 0), end = number_at(table, i, "end", 0);
    const std::string what = residual_class(table, i);
    auto fate = std::find_if(fates.begin(), fates.end(), [&](const auto& each) { return each.first == what; });
    if (fate == fates.end()) fate = fates.insert(fates.end(), {what, {}});
    fate->second.push_back(method);
    const bool ok = text_at(table, i, "verdict") == "ok";
    const double share = number_at(table, i, "largest residual", 0) / turned;
    page.rows.push_back(
        {method, step_text(number_at(table, i, "step", 0)), ok ? what : fmt::format("{} at {:.3g} s", what, end),
         std::isfinite(share) ? nice(share) : "",
         ok ? fmt::format("{:.3g}", std::pow(10, number_at(table, i, "growth of the residual", 0))) : "",
         ok ? nice(number_at(table, i, "equivalent drag", 0)) : ""});
    Curve curve{title, style_of(method), {}};
    for (const auto& [t, worst] : points_of(rows, method, "largest residual", true))
      if (const double y = worst / turned; t > 0 && y > 1e-17 && y < 3) {
        curve.points.emplace_back(t, y);
        lowest = std::min(lowest, y);
      }
    if (!ok) f.failures.push_back({title + ": " + what, style_of(method), end, 1});
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.y.low = std::pow(10, std::floor(std::log10(lowest)));
  f.finding = "What becomes of the energy that does not add up.";
  for (const auto& [what, methods] : fates) f.finding += fmt::format(" {}: {}.", capital(what), joined(methods));
  f.tier = "exact (it is zero), to the rounding of the sums";
  f.caption = fmt::format(
      "Scene {}, nothing damps it; {}; rules that solve the whole step at ten times the step; "
      "commit {}.",
      scene, length_text(table, scene), commit);
  Chart chart{"", std::monostate{}, "energy", "", f.title};
  // nothing can be drawn of a scene at rest, or of engines that claim no closure
  if (!f.curves.empty()) chart.figure = std::move(f);
  chart.tables.push_back(std::move(page));
  return chart;
}

/// The drag that rules add by themselves.
Chart damping_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "energy-damping";
  f.title = "Numerical damping: the drag that a rule adds by itself";
  f.x = {"step times frequency, h ω", true, std::nullopt, std::nullopt};
  f.y = {"equivalent drag / ω", true, 1e-9, 3.0};
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
      // what theory puts at zero is the slope of an oscillation, that is noise
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
  f.finding += " Backward Euler takes, at h ω = 1, as much as a drag of 0.69 ω, more than a third of critical damping.";
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

/// The longest time and its steps, of any run of the scene: "100 s, 100000 steps of 0.001 s".
}  // namespace

std::vector<Chart> energy_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const Table* table = input.result.table("energy")) {
    for (const std::string& scene : distinct(*table, "scene"))
      if (auto chart = budget_chart(*table, scene, input.commit)) charts.push_back(std::move(*chart));
    for (const std::string& scene : distinct(*table, "scene")) {
      const Table* rows = input.result.table(scene + "-ledger");
      bool undamped = false;
      for (size_t i = 0; i < table->rows.size(); ++i)
        undamped |= text_at(*table, i, "scene") == scene && flag_at(*table, i, "undamped");
      if (undamped && rows) charts.push_back(drift_chart(*table, *rows, scene, input.commit));
    }
  }
  if (const Table* table = input.result.table("energy-damping")) charts.push_back(damping_chart(*table, input.commit));
  return charts;
}

}  // namespace crosscheck
