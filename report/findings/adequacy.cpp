// Findings on how little model is enough.

#include <algorithm>
#include <cmath>

#include "experiments/tables/adequacy.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// What is said of a scene at one tolerance; nothing where other starts may need less.
std::optional<Finding> finding_of(const LeastModel& least, const std::string& scene) {
  Finding f{.rule = "least-model-full", .scene = scene, .words = {{"gone", ingredients_text(least.left_out)}}};
  if (!least.left_out.empty())
    f.rule = least.holds ? "least-model" : "least-model-fails",
    f.value = least.holds ? 100 * (1 - least.cost) : least.failing;
  else if (!least.holds)
    return std::nullopt;
  f.words["starts"] = std::to_string(least.starts);
  return f;
}

/// One for each scene and what is said of it, with the tolerances that it is said at.
void least_models(const TableSet& rows, std::vector<Finding>& out) {
  std::vector<std::string> scenes, whole;
  for (const LeastModelRow& row : rows_of<LeastModelRow>(rows))
    if (!std::ranges::count(scenes, row.scene)) scenes.push_back(row.scene);
  for (const std::string& scene : scenes) {
    std::vector<Finding> said;
    std::vector<std::vector<std::string>> tolerances;
    for (const LeastModel& least : least_models_of(rows, scene)) {
      const auto f = finding_of(least, scene);
      if (!f) continue;
      if (said.empty() || said.back().rule != f->rule || said.back().value != f->value || said.back().words != f->words)
        said.push_back(*f), tolerances.emplace_back();
      tolerances.back().push_back(least.of_motion(1)    ? "within 1 %"
                                  : least.of_motion(10) ? "within 10 %"
                                                        : "within its tolerance");
    }
    if (said.size() == 1 && said[0].rule == "least-model-full") {
      whole.push_back(scene);
      continue;
    }
    for (size_t i = 0; i < said.size(); ++i) {
      said[i].words["within"] = joined(tolerances[i]);
      out.push_back(said[i]);
    }
  }
  if (!whole.empty())
    out.push_back(
        {.rule = "least-model-none", .value = static_cast<double>(whole.size()), .words = {{"where", listed(whole)}}});
}

void families(const TableSet& rows, std::vector<Finding>& out) {
  std::vector<Finding> all;
  for (const AdequacyRow& row : rows_of<AdequacyRow>(rows)) {
    const size_t noun = row.left_out.find(" springs");
    const std::string family = row.left_out.substr(0, noun);
    // a part of no motion is no measure
    if ((family != "structural" && family != "shear" && family != "bend") || row.kind != ModelKind::single ||
        !row.error || !(row.motion > row.tolerance))
      continue;
    const double part = 100 * *row.error / row.motion;
    if (all.empty() || all.back().scene != row.scene)
      all.push_back({.rule = "families", .scene = row.scene, .value = -1, .tier = row.truth});
    Finding& f = all.back();
    if (!f.low || part < *f.low) f.low = part, f.words["least"] = family;
    if (part > f.value) f.value = part, f.high = part, f.words["most"] = family;
  }
  for (Finding& f : all)
    if (f.words["least"] != f.words["most"]) out.push_back(std::move(f));
}

Finding power_finding(const std::string& rule, const PowerLaw& power) {
  return {.rule = rule,
          .value = power.exponent,
          .low = power.exponent - power.deviation,
          .high = power.exponent + power.deviation};
}

void grids(const TableSet& rows, std::vector<Finding>& out) {
  for (const ScalingRow& row : rows_of<ScalingRow>(rows))
    if (row.quantity == ScalingQuantity::stiffness_for_sag) {
      Finding f = power_finding("grid-powers", {row.exponent, row.standard_error});
      f.scene = row.scene;
      out.push_back(std::move(f));
    }
}

}  // namespace

/// The power by which bend springs must stiffen against the derived 4, with the cause of the difference: the derivation
/// counts as many bend springs as cells, and a line has half a one less, as none crosses the free end.
std::vector<Finding> bend_findings(const TableSet& rows) {
  constexpr double derived = 4, close = 0.05;
  const auto of_cells = power_of(rows, "", droop_stiffness);
  if (!of_cells) return {};
  std::vector<std::pair<double, double>> points;  // against the number of bend springs in a line instead of its cells
  for (const BendingRow& row : rows_of<BendingRow>(rows))
    points.emplace_back(static_cast<double>(row.particles) - 2, row.stiffness);
  const auto of_springs = power_law(points);
  const double off = std::abs(of_cells->exponent - derived),
               left = of_springs ? std::abs(of_springs->exponent - derived) : INFINITY;
  const bool differs = off > std::max(close, 2 * of_cells->deviation);
  std::vector<Finding> out{power_finding("bend-power", *of_cells)};
  out[0].words = {{"derived", fmt::format("{:g}", derived)}, {"open", differs && !(left < off) ? "; unexplained" : ""}};
  if (differs && left < off) {
    out.push_back(power_finding("bend-power-by-springs", *of_springs));
    out[1].words = {{"part", left <= close ? "nearly all" : "only a part"}};
  }
  return out;
}

std::vector<Finding> adequacy_findings(const TableSet& rows) {
  std::vector<Finding> out;
  for (const auto part : {least_models, families, grids}) part(rows, out);
  for (Finding& f : bend_findings(rows)) out.push_back(std::move(f));
  return out;
}

}  // namespace crosscheck
