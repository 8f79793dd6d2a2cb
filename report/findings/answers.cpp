#include "report/findings/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/sphere.h"
#include "experiments/tables/stability.h"
#include "mysim/base/text.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {

const std::vector<Question>& questions() {
  static const std::vector<Question> table = {
      {"Do they agree?", "same-answer", "certificate"},
      {"Which method, which step?", "speed-accuracy", "chart"},
      {"Where do methods fail?", "stability", "chart"},
      {"What happens at the ball?", "energy", "picture", "answer-energy", "What happens to the energy?"},
      {"What can be left out?", "adequacy", "chart"},
  };
  return table;
}

const Finding* answer_to(const Question& question, const std::vector<Finding>& findings) {
  for (const Finding& f : findings)
    if (const FindingRule& rule = finding_rule(f.rule); rule.topic == "answer" && rule.chapter == question.chapter)
      return &f;
  return nullptr;
}

namespace {

/// The largest difference so far, and the scene of it.
struct Largest {
  double value = -1;
  std::string where;
  void take(double other, const std::string& scene) {
    if (other > value) value = other, where = scene;
  }
  bool any() const { return value >= 0; }
};

/// Another engine's method with the least difference from mysim's representative, or null.
const MethodData* nearest_other(const SceneData& scene) {
  const MethodData* best = nullptr;
  for (const MethodData& m : scene.methods)
    if (m.ok() && m.difference && is_another_engine(m.method) && (!best || *m.difference < *best->difference))
      best = &m;
  return best;
}

/// Without a method of mysim's rule in another engine: how far the nearest other one is.
std::optional<Finding> difference_answer(const std::vector<SceneData>& data) {
  Largest apart, growth;
  std::string method;
  bool round_off = true;  // no more anywhere
  for (const SceneData& scene : data) {
    const MethodData* other = nearest_other(scene);
    if (!other) continue;
    if (!other->round_off && !scene.touched()) {
      growth.take(scene.growth, scene.scene);
      continue;
    }
    round_off &= other->round_off && !scene.touched() && *other->difference <= *other->round_off;
    if (*other->difference > apart.value) apart.take(*other->difference, scene.scene), method = other->method;
  }
  if (!apart.any() && growth.any())
    return Finding{.rule = "answer-chaotic", .value = growth.value, .words = {{"where", growth.where}}};
  if (!apart.any()) return std::nullopt;
  return Finding{.rule = round_off ? "answer-same-motion" : "answer-difference",
                 .method = ours,
                 .other = method,
                 .value = apart.value,
                 .words = {{"where", apart.where}}};
}

/// Another engine's method beside mysim's representative at the same step, over the scenes without contact and other
/// laws.
struct EngineApart {
  std::string method;
  Largest apart = {};
  bool same = true, another = false;  // rule: equal on all of them; another on one
};

std::vector<EngineApart> engines_apart(const std::vector<SceneData>& data) {
  std::vector<EngineApart> engines;
  for (const SceneData& scene : data)
    for (const MethodData& m : scene.methods) {
      if (!is_another_engine(m.method) || !stands_for_its_engine(m.method) || !m.ok() || !m.difference ||
          scene.touched() || !m.different_law.empty())
        continue;
      auto known = std::ranges::find(engines, m.method, &EngineApart::method);
      if (known == engines.end()) known = engines.insert(engines.end(), {m.method});
      known->apart.take(*m.difference, scene.scene);
      known->same &= m.same_rule.value_or(false), known->another |= !m.same_rule.value_or(true);
    }
  return engines;
}

/// The reader's programs that died or took too long wherever they ran.
std::vector<std::string> silent_programs(const std::vector<SceneData>& data) {
  std::set<std::string> silent, heard;
  for (const SceneData& scene : data)
    for (const MethodData& m : scene.methods)
      if (family_of(m.method).role == Role::outside)
        (m.gave_no_answer() ? silent : heard).insert(name_in_sentence(m.method));
  for (const std::string& name : heard) silent.erase(name);
  return {silent.begin(), silent.end()};
}

std::optional<Finding> agreement_answer(const std::vector<Scene>&, const std::vector<SceneData>& data,
                                        const TableSet&) {
  const std::vector<EngineApart> engines = engines_apart(data);
  size_t same = 0;
  Largest worst, in_contact, beyond;
  std::vector<std::string> differing, agreeing;
  std::string differs;
  for (const SceneData& scene : data) {
    bool compared = false;
    for (const MethodData& m : scene.methods) {
      const auto engine = std::ranges::find(engines, m.method, &EngineApart::method);
      if (!m.same_rule.value_or(false) || !m.ok() || !m.difference || !stands_for_its_engine(m.method)) continue;
      if (scene.touched() && is_another_engine(m.method)) in_contact.take(*m.difference, scene.scene);
      if (scene.touched() || engine == engines.end() || !m.different_law.empty() || !m.round_off) continue;
      if (same_rule_differs(scene, m)) {
        differing.push_back(scene.scene);
        if (*m.difference > beyond.value) beyond.take(*m.difference, scene.scene), differs = engine_of(m.method);
      } else if (engine->same) {
        compared = true, worst.take(*m.difference, scene.scene);
        if (std::ranges::find(agreeing, m.method) == agreeing.end()) agreeing.push_back(m.method);
      }
    }
    same += compared;
  }
  differing.erase(std::ranges::unique(differing).begin(), differing.end());
  if (!differing.empty())
    return Finding{.rule = "answer-agreement-no",
                   .method = ours,
                   .other = differs,
                   .value = beyond.value,
                   .words = {{"where", listed(differing)}}};
  if (same == 0 && in_contact.any())
    return Finding{.rule = "answer-agreement-contact",
                   .method = ours,
                   .value = in_contact.value,
                   .words = {{"where", in_contact.where}}};
  if (same == 0) return difference_answer(data);
  // a peer stands last in the list of engines that agree; the reader's programs that do not, or not surely, come after
  // it, and leave no room for contact
  std::ranges::stable_partition(agreeing,
                                [](const std::string& name) { return family_of(name).role == Role::outside; });
  const std::string last = agreeing.back();
  agreeing.pop_back();
  std::string names, after;
  for (const std::string& name : agreeing) names += ", " + name_in_sentence(engine_of(name));
  for (const EngineApart& each : engines)
    if (family_of(each.method).role == Role::outside && !each.same)
      after += fmt::format("; {} by {}{}", name_in_sentence(each.method) + (each.another ? " (other rule)" : ""),
                           each.another ? "" : "up to ", nice_length(each.apart.value));
  if (const auto silent = silent_programs(data); !silent.empty())
    after += fmt::format("; {} gave no answer", joined(silent));
  if (after.empty() && names.empty() && in_contact.any())
    after = "; with contact by at most " + nice_length(in_contact.value);
  return Finding{.rule = "answer-agreement",
                 .method = ours,
                 .other = engine_of(last),
                 .value = worst.value,
                 .words = {{"most", worst.value == 0 ? "nothing" : "at most " + nice_length(worst.value)},
                           {"scenes", counted(same, "scene")},
                           {"contact", after},
                           {"programs", names}}};
}

/// What the cheapest run of another engine costs beside mysim's; a tie is told as one.
std::string beside_text(const EngineBeside& other) {
  const std::string name = name_in_sentence(other.method);
  return other.low <= 1 && other.high >= 1
             ? fmt::format(". {} within 1 %: as much, within noise", name)
             : fmt::format(". {} within 1 %: {} times the computing", name, times_text(other.times));
}

std::optional<Finding> method_answer(const std::vector<Scene>& scenes, const std::vector<SceneData>&,
                                     const TableSet& rows) {
  const Scene* scene = main_scene(scenes, rows);
  const auto run = scene ? recommended_run(scene->name, 0.01, rows) : std::nullopt;
  if (!run) return std::nullopt;
  const double to_percent = 100 / run->motion;
  // the quotient is over mysim's run; the others' stand in the chapter
  const bool compared = family_of(run->method).is_subject() && !run->beside.empty();
  const auto next = std::ranges::min_element(run->beside, {}, &EngineBeside::times);
  return Finding{.rule = "answer-method",
                 .scene = scene->name,
                 .method = run->method,
                 .other = compared ? next->engine : "",
                 .value = run->error * to_percent,
                 .low = std::max(0., run->error - run->error_bar) * to_percent,
                 .high = (run->error + run->error_bar) * to_percent,
                 .words = {{"setting", setting_of(*run)},
                           {"speed", speed_text(*run, *scene)},
                           {"beside", compared ? beside_text(*next) : ""}}};
}

/// Without an experiment on stability: the runs at the scenes' own steps.
std::optional<Finding> failed_runs_answer(const std::vector<SceneData>& data) {
  size_t failed = 0, all = 0;
  std::vector<std::string> names;
  for (const SceneData& each : data)
    for (const MethodData& m : each.methods) {
      all += m.supported();
      if (!m.supported() || m.ok()) continue;
      ++failed;
      if (const std::string name = name_in_sentence(m.method); std::ranges::find(names, name) == names.end())
        names.push_back(name);
    }
  if (all == 0) return std::nullopt;
  if (failed == 0) return Finding{.rule = "answer-none-failed", .value = static_cast<double>(all)};
  return Finding{.rule = "answer-failed",
                 .value = static_cast<double>(failed),
                 .words = {{"runs", counted(all, "run")}, {"which", listed(names)}}};
}

/// The limit of the main scene about a state, and how near all limits there are to theory. About a start, where theory
/// does not see what follows, the truth must have confirmed it.
std::optional<Finding> limit_answer(const Scene& scene, const TableSet& rows, LimitState state) {
  const auto run = recommended_run(scene.name, 0.01, rows);
  std::optional<LimitRow> shown;
  const std::vector<LimitRow> table = rows_of<LimitRow>(rows);
  for (const LimitRow& row : table)
    if (row.scene == scene.name && row.state == state && row.predicted && row.measured &&
        (state == LimitState::rest || confirmed_by_truth(row)) && family_of(row.method).is_subject() &&
        (!shown || (run && row.method == run->method)))
      shown = row;
  const StepLimitCounts limits = step_limit_counts(table, state);
  if (!shown || limits.agreeing == 0) return std::nullopt;
  const size_t all = limits.agreeing + limits.coarse + limits.apart;
  return Finding{
      .rule = "answer-limit",
      .method = shown->method,
      .value = *shown->measured,
      .low = shown->held,
      .high = shown->failed,
      .words = {{"where", shown->scene},
                {"theory", step_text(*shown->predicted)},
                {"limits", all == 1                 ? std::string("The one limit measured lies")
                           : limits.agreeing == all ? fmt::format("All {} limits measured lie", all)
                                                    : fmt::format("{} of {} limits lie", limits.agreeing, all)},
                {"within", percent(limits.within, 1)}}};
}

std::optional<Finding> failure_answer(const std::vector<Scene>& scenes, const std::vector<SceneData>& data,
                                      const TableSet& rows) {
  if (const Scene* scene = main_scene(scenes, rows))
    for (const LimitState state : {LimitState::rest, LimitState::start})
      if (auto answer = limit_answer(*scene, rows, state)) return answer;
  return failed_runs_answer(data);
}

/// The last scene on which something touches and another engine has a difference.
const SceneData* last_contact(const std::vector<SceneData>& data) {
  const SceneData* last = nullptr;
  for (const SceneData& scene : data)
    if (scene.touched() && nearest_other(scene)) last = &scene;
  return last;
}

std::optional<Finding> ball_answer(const std::vector<Scene>&, const std::vector<SceneData>& data,
                                   const TableSet& rows) {
  std::vector<ConeCount> counts = cone_counts(rows);
  std::erase_if(counts, [](const ConeCount& c) { return !stands_for_its_engine(c.method); });
  const SceneData* scene = last_contact(data);
  const MethodData* other = scene ? nearest_other(*scene) : nullptr;
  bool same_rule = false;
  if (scene)
    for (const MethodData& m : scene->methods)
      if (is_another_engine(m.method) && m.ok() && m.difference && m.same_rule.value_or(false) && !same_rule)
        other = &m, same_rule = true;
  if (counts.empty() || counts[0].method != ours) {
    if (!scene) return std::nullopt;
    return Finding{.rule = "answer-contact",
                   .method = ours,
                   .other = other->method,
                   .value = *other->difference,
                   .words = {{"where", scene->scene}, {"until", step_text(scene->window)}}};
  }
  // of many the two that err most
  const ConeCount first = counts[0];
  counts.erase(counts.begin());
  if (counts.size() > 2) std::ranges::stable_sort(counts, {}, &ConeCount::right);
  counts.resize(std::min<size_t>(counts.size(), 2));
  std::string others, engine;
  for (const ConeCount& count : counts) {
    const bool again = engine_of(count.method) == engine;
    engine = engine_of(count.method);
    others += fmt::format(", {} in {}{}", again ? name_beside_engine(count.method) : name_in_sentence(count.method),
                          count.right, count.all == first.all ? "" : fmt::format(" of {}", count.all));
  }
  return Finding{.rule = "answer-ball",
                 .method = std::string(subject().name),
                 .value = static_cast<double>(first.right),
                 .words = {{"cases", std::to_string(first.all)},
                           {"others", others},
                           {"drape", same_rule ? fmt::format(". On {}, same rule: {} apart until {}", scene->scene,
                                                             nice_length(*other->difference), step_text(scene->window))
                                               : ""}}};
}

/// Where nothing touches: how far the balance of mysim's best stays open, and what backward Euler takes.
std::optional<Finding> energy_answer(const std::vector<Scene>& scenes, const std::vector<SceneData>& data,
                                     const TableSet& rows) {
  if (ball_answer(scenes, data, rows)) return std::nullopt;
  std::optional<double> drag;
  for (const DampingRow& row : rows_of<DampingRow>(rows))
    if (row.equivalent_drag && std::abs(row.h_omega - 0.1) < 1e-9 && row.method == "mysim/implicit-euler")
      drag = *row.equivalent_drag * row.step / row.h_omega;
  // of the subject's methods the symplectic one that keeps it best
  std::optional<Finding> best;
  for (const EnergyRow& row : rows_of<EnergyRow>(rows)) {
    const bool shown = std::ranges::any_of(scenes, [&](const Scene& s) { return s.name == row.scene; });
    if (!shown || !family_of(row.method).is_subject() || !row.symplectic || row.verdict != Verdict::ok ||
        !row.closure_claimed || !row.largest_residual || !(row.turned_over.value_or(0) > 0))
      continue;
    const double open = 100 * *row.largest_residual / *row.turned_over;
    if (best && best->value <= open) continue;
    best = Finding{
        .rule = "answer-energy",
        .method = row.method,
        .value = open,
        .words = {{"where", row.scene},
                  {"damping",
                   drag ? fmt::format("; on one spring implicit-euler damps like a drag of {:.2g} ω at hω = 0.1", *drag)
                        : ""}}};
  }
  return best;
}

std::optional<Finding> model_answer(const std::vector<Scene>& scenes, const std::vector<SceneData>&,
                                    const TableSet& rows) {
  const Scene* scene = main_scene(scenes, rows);
  if (!scene) scene = scenes.empty() ? nullptr : &scenes.back();
  if (!scene) return std::nullopt;
  std::string one, ten;
  double cost = 1;
  for (const LeastModel& least : least_models_of(rows, scene->name)) {
    if (!least.holds) continue;
    if (least.of_motion(1)) one = ingredients_text(least.left_out, 1);
    if (least.of_motion(10)) ten = ingredients_text(least.left_out, 2), cost = least.cost;
  }
  if (one.empty() || ten.empty()) return std::nullopt;
  return Finding{.rule = one != ten         ? "answer-model"
                         : ten == "nothing" ? "answer-model-none"
                                            : "answer-model-same",
                 .scene = scene->name,
                 .value = 100 * cost,
                 .words = {{"one", one}, {"ten", ten}}};
}

}  // namespace

std::vector<Finding> answer_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& data,
                                     const TableSet& rows) {
  std::vector<Finding> all;
  for (const auto answer : {agreement_answer, method_answer, failure_answer, ball_answer, energy_answer, model_answer})
    if (auto finding = answer(scenes, data, rows)) all.push_back(std::move(*finding));
  return all;
}

}  // namespace crosscheck
