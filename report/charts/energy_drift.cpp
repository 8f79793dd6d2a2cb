// Energy that does not add up over a long time, where nothing takes or gives any.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/charts/energy_parts.h"
#include "report/findings_text.h"
#include "report/residual_word.h"

namespace crosscheck {
namespace {

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

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
    const std::string what = residual_word(table, i);
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

}  // namespace crosscheck
