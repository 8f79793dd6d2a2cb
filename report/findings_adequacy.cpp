// Sentences on how little model is enough.
#include <map>

#include "experiments/cells.h"
#include "report/findings.h"
#include "report/findings_text.h"
#include "report/grid_powers.h"

namespace crosscheck {
namespace {

void least_models(const Table& t, std::vector<Finding>& out) {
  std::vector<std::string> whole, less, unsure;
  std::map<std::string, std::vector<std::string>> at_tenth;  // what can go -> scenes
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const std::string scene = text_at(t, i, "scene"), gone = text_at(t, i, "left out"),
                      is = text_at(t, i, "tolerance is");
    const bool holds = flag_at(t, i, "holds");
    if (is == "the scene's own") {
      if (!holds)
        unsure.push_back(scene);
      else if (gone.empty())
        whole.push_back(scene);
      else
        less.push_back(fmt::format("{} ({})", scene, gone));
    } else if (is.starts_with("10 %") && holds && !gone.empty()) {
      at_tenth[gone].push_back(scene);
    }
  }
  std::string sentence;
  if (!whole.empty())
    sentence += fmt::format("Nothing can be left out of {} within their tolerances, also from three other starts. ",
                            joined(whole));
  if (!less.empty()) sentence += fmt::format("Within their tolerances these can do with less: {}. ", joined(less));
  if (!unsure.empty())
    sentence +=
        fmt::format("What can be left out of {} within {} depends on the start: of three others not all bear it out. ",
                    joined(unsure), unsure.size() == 1 ? "its tolerance" : "their tolerances");
  for (const auto& [gone, scenes] : at_tenth)
    sentence += fmt::format("At 10 % of the motion {} can do without {}. ", joined(scenes), gone);
  if (sentence.empty()) return;
  sentence.pop_back();
  out.push_back({"", "adequacy", sentence, "see each scene", "least-model"});
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
  if (const Table* t = result.table("adequacy-least")) least_models(*t, out);
  if (const Table* t = result.table("adequacy")) families(*t, out);
  if (const Table* t = result.table("adequacy-scaling")) grids(result, *t, out);
  return out;
}

}  // namespace crosscheck
