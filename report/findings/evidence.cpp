// The table of rules, and the rows that each finding rests on.
#include "report/findings/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/tables/table.h"
#include "mysim/base/hash.h"
#include "report/findings/recommendation.h"

namespace crosscheck {

const std::vector<FindingRule>& finding_rules() {
  static const std::vector<FindingRule> rules = {
      {"same-rule",
       "largest difference = max over samples up to the window of the RMS distance from mysim/symplectic-euler; agrees "
       "where it is at most the round-off bound",
       {"engines"},
       "{}-agreement"},
      {"nearest",
       "least of largest error = max over samples up to the window of the RMS distance from the truth, over runs that "
       "are ok; never said to be less than the truth bar",
       {"engines"},
       "{}-error"},
      {"other-law", "largest error, and largest error / motion, of bullet/pbd", {"engines"}, "{}-error"},
      {"failed",
       "runs whose verdict is not ok, at their end; predicted step limit where it is below the step",
       {"engines"},
       "{}-error"},
      {"clearance", "smallest clearance and creep at end of runs that are ok", {"engines"}, "{}-clearance"},
      {"converged-contact",
       "largest difference from converged contact, up to truth until",
       {"engines"},
       "{}-converged"},
      {"sticky", "largest difference of centres of mysim/symplectic-euler+sticky", {"engines"}, "{}-centres"},
      {"agreement-of-all", "over scenes: max of largest difference, and of largest difference of centres", {"engines"}},
      {"nearest-of-all",
       "over scenes: which engine's least largest error is the lesser, of runs that are ok; shared where both are "
       "within "
       "1.05 times the least, or within the truth bar",
       {"engines"},
       "scoreboard"},
      {"other-law-of-all",
       "over scenes of one kind: min and max of largest error / motion of bullet/pbd",
       {"engines"},
       "scoreboard"},
      {"which-method",
       "of runs that are ok the least of largest error / motion, by engine, and who is above 0.1; verdicts that are "
       "not "
       "ok; left out where it holds at 1 % and 10 % of the motion",
       {"engines", "adequacy-least"}},
      {"failed-of-all", "runs whose verdict is not ok, where another method's is ok", {"engines"}, "scoreboard"},
      {"orders",
       "max of |measured order - declared order|; how many methods and scenes",
       {"order-slopes"},
       "spring-order"},
      {"cheapest",
       "at part of motion = 0.01 and measure = error: method and what is as cheap within noise, and min and max of "
       "Bullet / mysim, in CPU time and in "
       "force evaluations; methods of speed-accuracy with less than two runs on a scene",
       {"speed-accuracy-cheapest-cost", "speed-accuracy-cheapest", "speed-accuracy", "engines"},
       "cheapest-1-percent-cost"},
      {"size-cost",
       "over sides: min and max of cpu per step of bullet/deformable-explicit / that of mysim/symplectic-euler+plain, "
       "and / "
       "that of mysim/symplectic-euler",
       {"size-cost"},
       "size-cost"},
      {"symplectic-energy",
       "over runs of symplectic rules whose balance closes: on undamped scenes max of largest residual / energy turned "
       "over; on the others min and max of largest residual / (|drag took| + |dashpots took| + |contact took|)",
       {"energy"},
       "*-energy-drift"},
      {"numerical-damping", "max of |equivalent drag / by theory - 1|", {"energy-damping"}, "energy-damping"},
      {"cone",
       "cases whose answer is the answer by theory, of those whose verdict is ok",
       {"sphere-cone"},
       "sphere-cone"},
      {"leaving",
       "angle - angle by theory at the shortest step: max of its absolute value over mysim's rules, and of every other "
       "method, there and at its longest step",
       {"sphere-leaving"},
       "sphere-leaving"},
      {"slide-off",
       "creep, and centre height less mysim's, of drop-aside at mysim's finest step",
       {"sphere-drape"},
       "drop-aside-sliding"},
      {"after-contact",
       "max of difference over the whole run, of the rules of mysim and of bullet/deformable-explicit, in the scene's "
       "own table",
       {"engines"},
       "{}-agreement"},
      {"penetration",
       "max over drops of particles and of triangles, in parts of the radius",
       {"sphere-penetration"},
       "drop-centred-penetration"},
      {"step-limits", "largest stable step / predicted", {"stability"}, "stability-limits"},
      {"known-disagreements", "rows, by world", {"disagreements"}},
      {"no-stable-step",
       "runs at rest whose prediction and measurement are no stable step; max of |deviation| of the growth in a step",
       {"stability", "stability-growth"},
       "stability-limits"},
      {"least-model",
       "left out at the scene's tolerance, at 1 % and at 10 % of the motion; 1 - cost of full; unseen errors above the "
       "tolerance where it does not hold; kept = ingredients less those left out",
       {"adequacy-least", "adequacy"},
       "*-adequacy"},
      {"families", "error / motion without one family of springs", {"adequacy"}, "*-adequacy"},
      {"grid-powers",
       "slope of log stiffness over log cells at the same sag",
       {"adequacy-scaling"},
       "adequacy-scaling"},
  };
  return rules;
}

const FindingRule& finding_rule(std::string_view name) {
  for (const FindingRule& rule : finding_rules())
    if (rule.name == name) return rule;
  throw std::logic_error("no rule for findings named " + std::string(name));
}

std::string figure_of(std::string_view name, const std::string& scene, const std::vector<std::string>& figures) {
  std::string wanted(finding_rule(name).figure);
  if (wanted.empty()) return "";
  if (const size_t at = wanted.find("{}"); at != std::string::npos) wanted.replace(at, 2, scene);
  const bool any = wanted.starts_with('*');
  std::string found;
  for (const std::string& figure : figures)
    if (any ? figure.ends_with(wanted.substr(1)) : figure == wanted) found = figure;
  return found;
}

namespace {

bool has_column(const Table& table, const char* name) {
  return std::any_of(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.name == name; });
}

template <class Keep>
Evidence rows_of(const Table& table, Keep keep) {
  Evidence evidence{table.name, {}, {}};
  std::string text;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (keep(i)) evidence.rows.push_back(static_cast<long>(i) + 1), text += csv_row(table.rows[i]) + "\n";
  evidence.fingerprint = fmt::format("{:016x}", Fnv1a::of(text));
  return evidence;
}

}  // namespace

Evidence evidence_of(const Table& table) {
  return rows_of(table, [](size_t) { return true; });
}

std::vector<Evidence> evidence_of(const Finding& finding, const Rows& result) {
  std::vector<Evidence> all;
  for (const std::string_view name : finding_rule(finding.rule).tables)
    if (const Table* table = result.table(std::string(name))) {
      const bool by_scene = !finding.scene.empty() && has_column(*table, "scene");
      all.push_back(
          rows_of(*table, [&](size_t i) { return !by_scene || text_or_none(*table, i, "scene") == finding.scene; }));
    }
  return all;
}

AllFindings all_findings(const std::vector<Scene>& scenes, const Rows& result) {
  AllFindings all;
  for (const Scene& scene : scenes) all.facts.push_back(scene_data(scene.name, result));
  all.overall = overall_findings(scenes, all.facts, result);
  for (size_t i = 0; i < scenes.size(); ++i) {
    all.of_scenes.push_back(findings_of(scenes[i], all.facts[i]));
    all.of_scenes.back().push_back(recommendation_finding(scenes[i], all.facts[i], result));
  }
  return all;
}

}  // namespace crosscheck
