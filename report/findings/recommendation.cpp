// The columns of the table of recommendations.
#include "report/findings/recommendation.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/table.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// A method's name in a column of its engine, else in full.
std::string name_in_engine(const std::string& method) {
  return family_of(method).by_default() ? method.substr(method.find('/') + 1) : method;
}

std::string share_text(double error, const SceneData& facts) {
  const double part = std::max(error, facts.error_bar) / facts.motion;
  if (part < 1e-5) return "< 0.001 %";
  return (error < facts.error_bar ? "< " : "") + percent(part, 1);
}

/// The most accurate of those that take part, in bold where none is more accurate. Of several equal ones the cheapest,
/// in force evaluations, which stands for them.
RecommendationCell nearest_cell(const SceneData& facts, const std::vector<MethodData>& among, const MethodData* m) {
  if (facts.tier.empty() || !m || !(facts.motion > 0)) return {};
  const MethodData* best = most_accurate(facts);
  const std::string engine = engine_of(m->method);
  for (const MethodData& each : among)
    if (each.judged() && engine_of(each.method) == engine && ties_with(each, *m, facts) && ties_with(*m, each, facts) &&
        each.evaluations < m->evaluations)
      m = &each;
  return {fmt::format("{}{} {}", name_in_engine(m->method), is_adaptive(m->method) ? "*" : "",
                      share_text(*m->error, facts)),
          ties_with(*m, *best, facts) ? "best" : ""};
}

RecommendationCell truth_cell(const Scene&, const SceneData& facts, const Rows&) {
  return facts.tier.empty() ? RecommendationCell{"none", "none"} : RecommendationCell{facts.tier, ""};
}

RecommendationCell ours_cell(const Scene&, const SceneData& facts, const Rows&) {
  return nearest_cell(facts, facts.methods, most_accurate(facts, &MethodFamily::is_subject));
}

RecommendationCell thrifty_cell(const Scene& scene, const SceneData& facts, const Rows&) {
  SceneData few = facts;
  std::erase_if(few.methods, [&](const MethodData& m) { return !m.single_evaluation(scene); });
  return nearest_cell(facts, few.methods, most_accurate(few, &MethodFamily::is_subject));
}

bool bullet_can(const SceneData& facts) {
  return std::any_of(facts.methods.begin(), facts.methods.end(),
                     [](const MethodData& m) { return family_of(m.method).is_default_peer() && m.supported(); });
}

RecommendationCell bullet_cell(const Scene& scene, const SceneData& facts, const Rows&) {
  if (!bullet_can(facts)) return {"cannot", "none"};
  // no truth: how far the same rule is from mysim's
  if (const MethodData* b = facts.find(theirs); facts.tier.empty() && b && b->ok() && b->difference)
    return {fmt::format("{} from mysim until {:.2g} s", nice_length(*b->difference), scene.window), "none"};
  return nearest_cell(facts, facts.methods, most_accurate(facts, &MethodFamily::is_default_peer));
}

/// Programs of the reader's own, single precision, independent integrators: where they were run.
RecommendationCell others_cell(const Scene&, const SceneData& facts, const Rows&) {
  SceneData others = facts;
  std::erase_if(others.methods, [](const MethodData& m) { return family_of(m.method).by_default(); });
  return nearest_cell(facts, others.methods, most_accurate(others));
}

/// Names of one method or several, without mysim's prefix.
std::string own_name(std::string methods) {
  const std::string prefix = std::string(subject().name) + "/";
  for (size_t at; (at = methods.find(prefix)) != std::string::npos;) methods.erase(at, prefix.size());
  return methods;
}

/// The cheapest method for 1 % of the motion, and the time of Bullet's cheapest over mysim's.
RecommendationCell cheapest_cell(const Scene& scene, const SceneData& facts, const Rows& result) {
  const Table* t = result.table("speed-accuracy-cheapest-cost");
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    const std::string method = text_or_none(*t, i, "method"), same = text_or_none(*t, i, "as cheap within noise");
    if (text_at(*t, i, "scene") != scene.name || number_at(*t, i, "part of motion") != 0.01 || method.empty() ||
        text_at(*t, i, "measure") != "error")
      continue;
    const auto factor = number_at(*t, i, "Bullet / mysim");
    return {fmt::format("{}{}{}", own_name(method), same.empty() ? "" : ", " + own_name(same),
                        factor              ? "; Bullet\u00a0×\u00a0" + times_text(*factor)
                        : bullet_can(facts) ? "; Bullet:\u00a0none"
                                            : ""),
            ""};
  }
  return {};
}

RecommendationCell fails_cell(const Scene&, const SceneData& facts, const Rows&) {
  std::vector<std::string> failed;
  std::vector<const MethodData*> off;
  int ran = 0;
  for (const MethodData& m : facts.methods) {
    if (!m.supported() || m.method == sticky_sphere) continue;
    ++ran;
    if (!m.ok()) failed.push_back(name_in_engine(m.method));
    if (is_useless(m, facts)) off.push_back(&m);
  }
  if (failed.empty() && off.empty()) return {fmt::format("none of {}", ran), ""};
  std::ranges::stable_sort(off, std::greater(), [](const MethodData* m) { return *m->error; });
  std::string text = failed.empty() ? "" : fmt::format("{} failed", fmt::join(failed, ", "));
  for (size_t i = 0; i < off.size(); ++i)
    text += fmt::format("{}{} {}",
                        i > 0          ? ", "
                        : text.empty() ? "off: "
                                       : "; off: ",
                        name_in_engine(off[i]->method), percent(*off[i]->error, facts.motion));
  return {fmt::format("{} (of {})", text, ran), "failed"};
}

RecommendationCell least_cell(const Scene& scene, const SceneData&, const Rows& result) {
  std::vector<std::string> out;
  std::string held = "nothing";  // at a stricter tolerance: it then is within a wider one
  for (const LeastModel& least : least_models_of(result, scene.name)) {
    if (least.holds && !least.left_out.empty())
      held = least.left_out +
             (scene.window < scene.duration ? fmt::format(" (until\u00a0{:.2g}\u00a0s)", scene.window) : "");
    if (least.of_motion(1) || least.of_motion(10)) out.push_back(held);
  }
  if (out.empty()) return {};
  if (std::all_of(out.begin(), out.end(), [&](const std::string& each) { return each == out[0]; })) return {out[0], ""};
  return {fmt::format("{}", fmt::join(out, " / ")), ""};
}

}  // namespace

const std::vector<RecommendationColumn>& recommendation_columns() {
  static const std::vector<RecommendationColumn> columns = {
      {"truth", "truth", truth_cell},
      {"mysim's nearest", "error", ours_cell},
      {"mysim's, one evaluation a step", "evaluation", thrifty_cell},
      {"Bullet's nearest", "motion", bullet_cell},
      {"nearest of others", "method", others_cell},
      {"cheapest for 1 %, CPU time", "cheapest", cheapest_cell, true},
      {"failed, or over 10 % off", "failed", fails_cell},
      {"not needed for 1 % / 10 %", "least", least_cell},
  };
  return columns;
}

std::vector<RecommendationCell> recommendations_of(const Scene& scene, const SceneData& facts, const Rows& result) {
  std::vector<RecommendationCell> cells;
  for (const RecommendationColumn& column : recommendation_columns())
    cells.push_back(column.cell(scene, facts, result));
  return cells;
}

Finding recommendation_finding(const Scene& scene, const SceneData& facts, const Rows& result) {
  std::vector<std::string> parts;
  for (const RecommendationColumn& column : recommendation_columns())
    if (const RecommendationCell cell = column.cell(scene, facts, result); !column.timed && !cell.empty())
      parts.push_back(fmt::format("{}: {}", column.head, cell.text));
  return {scene.name, recommendation_topic, fmt::format("{}.", fmt::join(parts, "; ")),
          facts.tier.empty() ? "another engine" : facts.tier, "which-method"};
}

}  // namespace crosscheck
