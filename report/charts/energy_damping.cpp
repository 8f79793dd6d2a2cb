// The drag that a rule adds by itself, measured on one spring beside the closed form.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/charts/energy_parts.h"
#include "report/findings_text.h"

namespace crosscheck {

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

}  // namespace crosscheck
