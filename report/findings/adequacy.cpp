#include <algorithm>
#include <cmath>

#include "experiments/tables/adequacy.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Returns nullopt if a smaller model might be adequate for other initial states.
std::optional<Finding> finding_of(const LeastModelRow& least, const std::string& until) {
  if (least.left_out.empty() && !least.holds) return std::nullopt;
  const auto unseen = {least.unseen_error_1, least.unseen_error_2, least.unseen_error_3};
  const auto fails = [&](const auto& error) { return !(error.value_or(INFINITY) <= least.tolerance); };
  return Finding{
      .rule = least.left_out.empty() ? "least-model.full"
              : least.holds          ? "least-model"
                                     : "least-model-fails",
      .scene = least.scene,
      .value = least.holds ? 100 * (1 - least.cost_of_full) : double(std::ranges::count_if(unseen, fails)),
      .words = {
          {"gone", ingredients_text(least.left_out)}, {"starts", std::to_string(unseen.size())}, {"until", until}}};
}

std::string text_of(ToleranceKind tolerance) {
  return tolerance == ToleranceKind::of_scene              ? "the scene's tolerance"
         : tolerance == ToleranceKind::hundredth_of_motion ? "1 %"
                                                           : "10 %";
}

}  // namespace

/// One finding for each distinct set of smallest models of a scene, with the tolerances that yield it.
Findings adequacy_findings(const Facts& facts) {
  Findings out;
  std::vector<std::string> scenes, whole;
  const std::vector<LeastModelRow> table = rows_of<LeastModelRow>(facts.rows);
  for (const LeastModelRow& row : table) add_once(scenes, row.scene);
  for (const std::string& scene : scenes) {
    const auto known = std::ranges::find(facts.scenes, scene, &Scene::name);
    const std::string until = known == facts.scenes.end() ? "" : step_text(known->window);
    Findings found;
    std::vector<std::vector<std::string>> tolerances;
    for (const LeastModelRow& least : table) {
      const auto f = least.scene == scene ? finding_of(least, until) : std::nullopt;
      if (!f) continue;
      if (found.empty() || found.back().rule != f->rule || found.back().value != f->value ||
          found.back().words != f->words)
        found.push_back(*f), tolerances.emplace_back();
      tolerances.back().push_back(text_of(least.tolerance_is));
    }
    if (found.size() == 1 && found[0].rule == "least-model.full") {
      whole.push_back(scene);
      continue;
    }
    for (size_t i = 0; i < found.size(); ++i) {
      found[i].words["within"] = joined(tolerances[i]);
      out.push_back(found[i]);
    }
  }
  if (!whole.empty())
    out.push_back({.rule = "least-model-none", .value = double(whole.size()), .words = {{"where", listed(whole)}}});
  return out;
}

/// Power of the number of cells by which bend springs must stiffen; theory gives 4 for many cells. The free length of n
/// particles has n - 3/2 cells, but only n - 2 bend springs, because none crosses the free end. A fit over the number
/// of springs is closer to 4.
Findings bend_findings(const Facts& facts) {
  const auto of_cells = power_of(facts.rows, "", ScalingQuantity::bend_stiffness_for_droop);
  if (!of_cells) return {};
  std::vector<std::pair<double, double>> points;  // number of bend springs along a line, their stiffness (N/m)
  for (const BendingRow& row : rows_of<BendingRow>(facts.rows))
    points.emplace_back(double(row.particles) - 2, row.stiffness);
  const auto of_springs = power_law(points);
  return {{.rule = "bend-power",
           .value = of_cells->exponent,
           .low = of_cells->exponent - of_cells->deviation,
           .high = of_cells->exponent + of_cells->deviation,
           .words = {{"derived", "4"}, {"springs", of_springs ? power_text(*of_springs) : ""}}}};
}

}  // namespace crosscheck
