// Sentences on how little model is enough.

#include <fmt/ranges.h>

#include <map>

#include "experiments/tables/table.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// "it can do without bend springs, which saves 33 % of the spring evaluations (kept: gravity, structural springs and
/// pins)"
std::string summary_of(const LeastModel& least, const Rows& rows, const std::string& scene) {
  if (!least.holds && least.left_out.empty()) return "from other starts less may be enough";
  std::string gone = least.left_out;  // "a, b" reads "a and b" in a sentence
  if (const size_t last = gone.rfind(", "); last != std::string::npos) gone.replace(last, 2, " and ");
  if (!least.holds)
    return fmt::format("without {} it fails from {} of {} other starts", gone, least.failing, least.starts);
  if (least.left_out.empty()) return "all is needed";
  const std::vector<std::string> kept = kept_without(rows, scene, least.left_out);
  return fmt::format("it can do without {}, which saves {:.0f} % of the spring evaluations{}", gone,
                     100 * (1 - least.cost), kept.empty() ? "" : fmt::format(" (kept: {})", joined(kept)));
}

std::string at_text(const LeastModel& least) {
  return least.tolerance == "the scene's own" ? "within its tolerance" : "at " + least.tolerance;
}

void least_models(const Rows& rows, const Table& t, std::vector<Finding>& out) {
  std::vector<std::string> whole, parts;
  for (const std::string& scene : distinct(t, "scene")) {
    std::vector<std::pair<std::vector<std::string>, std::string>> lines;  // tolerances, and what is said at them
    for (const LeastModel& least : least_models_of(rows, scene)) {
      const std::string text = summary_of(least, rows, scene);
      if (lines.empty() || lines.back().second != text) lines.push_back({{}, text});
      lines.back().first.push_back(at_text(least));
    }
    if (lines.size() == 1 && lines[0].second == "all is needed") {
      whole.push_back(scene);
      continue;
    }
    std::vector<std::string> said;
    for (const auto& [tolerances, text] : lines) said.push_back(joined(tolerances) + " " + text);
    parts.push_back(fmt::format("On {} {}.", scene, fmt::join(said, "; ")));
  }
  std::string sentence;
  if (!parts.empty()) sentence = fmt::format("{}", fmt::join(parts, " "));
  if (!whole.empty())
    sentence += fmt::format("{}Nothing can be left out of {}, not even at 10 % of the motion.",
                            sentence.empty() ? "" : " ", joined(whole));
  if (!parts.empty()) sentence += " All this holds while single positions can be compared.";
  if (!sentence.empty()) out.push_back({"", "adequacy", sentence, "see each scene", "least-model"});
}

void families(const Table& t, std::vector<Finding>& out) {
  std::map<std::string, std::string> per_scene;
  std::vector<std::string> order;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const std::string scene = text_at(t, i, "scene"), gone = text_at(t, i, "left out");
    const bool family = gone == "structural springs" || gone == "shear springs" || gone == "bend springs";
    const auto error = number_at(t, i, "error");
    if (!family || text_at(t, i, "kind") != "single" || !error) continue;
    if (per_scene[scene].empty()) order.push_back(scene);
    // a part of no motion is no measure
    const double motion = number_at(t, i, "motion", 0);
    per_scene[scene] +=
        fmt::format("{}{} {}", per_scene[scene].empty() ? "" : ", ", gone.substr(0, gone.find(' ')),
                    motion > number_at(t, i, "tolerance", 0) ? percent(*error, motion)
                                                             : nice_length(*error) + " (hardly any motion)");
  }
  std::string sentence;
  for (const std::string& scene : order)
    sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", scene, per_scene[scene]);
  if (!sentence.empty())
    out.push_back({"", "adequacy",
                   fmt::format("What leaving out a family of springs costs, in parts of the motion: {}.", sentence),
                   "see each scene", "families"});
}

void grids(const Rows& rows, const Table& t, std::vector<Finding>& out) {
  std::vector<std::string> all;
  for (const std::string& scene : distinct(t, "scene"))
    if (const auto power = power_of(rows, scene, stiffness_for_sag))
      all.push_back(fmt::format("{} on {}", power_text(*power), scene));
  std::string sentence;
  if (!all.empty())
    sentence = fmt::format(
        "For the same sag on a finer grid all stiffnesses go as the number of cells to the power {}.", joined(all));
  if (const std::string bend = bend_sentence(rows); !bend.empty()) sentence += (sentence.empty() ? "" : " ") + bend;
  if (!sentence.empty()) out.push_back({"", "adequacy", sentence, "measured", "grid-powers"});
}

}  // namespace

std::vector<Finding> adequacy_findings(const Rows& result) {
  std::vector<Finding> out;
  if (const Table* t = result.table("adequacy-least")) least_models(result, *t, out);
  if (const Table* t = result.table("adequacy")) families(*t, out);
  if (const Table* t = result.table("adequacy-scaling")) grids(result, *t, out);
  return out;
}

}  // namespace crosscheck
