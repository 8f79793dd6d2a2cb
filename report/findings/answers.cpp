#include "report/findings/answers.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/stability.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {

const std::vector<Question>& questions() {
  static const std::vector<Question> table = {
      {"Do they agree?", "same-answer", "certificate", {"answer-agreement", "answer-chaotic"}},
      {"Which method, which step?", "speed-accuracy", "chart", {"answer-method"}},
      {"Where do methods fail?", "stability", "chart", {"answer-limit", "answer-failed"}},
      {"What happens in contact?", "energy", "chart", {"answer-ball", "answer-contact"}},
      {"Which methods keep the energy?", "energy", "chart", {"answer-energy"}},
      {"What can be left out?", "adequacy", "chart", {"answer-model"}},
  };
  return table;
}

const Finding* answer_to(const Question& question, const Findings& findings) {
  for (const Finding& f : findings)
    if (std::ranges::count(question.rules, finding_rule(f.rule).key) > 0) return &f;
  return nullptr;
}

std::string answers_of_chapter(std::string_view chapter, const Findings& findings) {
  Findings answers;
  for (const Question& question : questions())
    if (const Finding* answer = question.chapter == chapter ? answer_to(question, findings) : nullptr)
      answers.push_back(*answer);
  return sentences_of(answers);
}

namespace {

struct Largest {
  double value = -1;
  std::string where;
  void take(double other, const std::string& scene) {
    if (other > value) value = other, where = scene;
  }
  bool any() const { return value >= 0; }
};

/// The method of another engine with the smallest difference from mysim's representative, or null.
const MethodData* nearest_other(const SceneData& scene) {
  const MethodData* best = nullptr;
  for (const MethodData& m : scene.methods)
    if (m.ok() && m.difference && is_another_engine(m.method) && (!best || *m.difference < *best->difference))
      best = &m;
  return best;
}

/// Difference of the nearest method; used if no other engine has the same rule as mysim.
Findings difference_answer(std::span<const SceneData> data) {
  Largest apart, growth;
  std::string method;
  bool round_off = true;  // no difference exceeds round-off
  for (const SceneData& scene : data) {
    const MethodData* other = nearest_other(scene);
    if (!other) continue;
    if (!other->round_off_bound && !scene.touched()) {
      growth.take(scene.growth, scene.scene);
      continue;
    }
    round_off &= other->round_off_bound && !scene.touched() && *other->difference <= *other->round_off_bound;
    if (*other->difference > apart.value) apart.take(*other->difference, scene.scene), method = other->method;
  }
  if (apart.any())
    return {{.rule = round_off ? "answer-agreement.same-motion" : "answer-agreement.difference",
             .method = ours,
             .other = method,
             .value = apart.value,
             .words = {{"where", apart.where}}}};
  if (growth.any()) return {{.rule = "answer-chaotic", .value = growth.value, .words = {{"where", growth.where}}}};
  return {};
}

/// Largest difference between another engine's method and mysim's representative at the same step. Excludes scenes with
/// contact, and runs with a different force law.
struct EngineApart {
  std::string method;
  Largest apart = {};
  bool same = true, another = false;  // same: same rule on every scene; another: different rule on some scene
};

std::vector<EngineApart> engines_apart(std::span<const SceneData> data) {
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

/// Programs that crashed or timed out on all their scenes.
std::vector<std::string> silent_programs(std::span<const SceneData> data) {
  std::set<std::string> silent, heard;
  for (const SceneData& scene : data)
    for (const MethodData& m : scene.methods)
      if (family_of(m.method).role == Role::outside)
        (m.gave_no_answer() ? silent : heard).insert(name_in_sentence(m.method));
  for (const std::string& name : heard) silent.erase(name);
  return {silent.begin(), silent.end()};
}

}  // namespace

Findings agreement_answer(const Facts& facts) {
  const std::vector<EngineApart> engines = engines_apart(facts.data);
  size_t same = 0;
  Largest worst, in_contact, beyond;
  std::vector<std::string> differing, agreeing;
  std::string differs;
  for (const SceneData& scene : facts.data) {
    bool compared = false;
    for (const MethodData& m : scene.methods) {
      const auto engine = std::ranges::find(engines, m.method, &EngineApart::method);
      if (!m.same_rule.value_or(false) || !m.ok() || !m.difference || !stands_for_its_engine(m.method)) continue;
      if (scene.touched() && is_another_engine(m.method)) in_contact.take(*m.difference, scene.scene);
      if (scene.touched() || engine == engines.end() || !m.different_law.empty() || !m.round_off_bound) continue;
      if (same_rule_differs(scene, m)) {
        differing.push_back(scene.scene);
        if (*m.difference > beyond.value) beyond.take(*m.difference, scene.scene), differs = engine_of(m.method);
      } else if (engine->same) {
        compared = true, worst.take(*m.difference, scene.scene);
        add_once(agreeing, m.method);
      }
    }
    same += compared;
  }
  differing.erase(std::ranges::unique(differing).begin(), differing.end());
  if (!differing.empty())
    return {{.rule = "answer-agreement.no",
             .method = ours,
             .other = differs,
             .value = beyond.value,
             .words = {{"where", listed(differing)}}}};
  if (same == 0 && in_contact.any())
    return {{.rule = "answer-agreement.contact",
             .method = ours,
             .value = in_contact.value,
             .words = {{"where", in_contact.where}}}};
  if (same == 0) return difference_answer(facts.data);
  // peers last
  std::ranges::stable_partition(agreeing,
                                [](const std::string& name) { return family_of(name).role == Role::outside; });
  std::vector<std::string> names{std::string(subject().name)}, others;
  for (const std::string& name : agreeing) names.push_back(name_in_sentence(engine_of(name)));
  for (const EngineApart& each : engines)
    if (family_of(each.method).role == Role::outside && !each.same)
      others.push_back(fmt::format("{}{}: {}", name_in_sentence(each.method), each.another ? " (other rule)" : "",
                                   nice_length(each.apart.value)));
  for (const std::string& name : silent_programs(facts.data)) others.push_back(name + ": no answer");
  const bool contact = others.empty() && agreeing.size() == 1 && in_contact.any();
  return {{.rule = "answer-agreement.yes",
           .method = ours,
           .other = engine_of(agreeing.back()),
           .value = worst.value,
           .words = {{"names", joined(names)},
                     {"scenes", std::to_string(same)},
                     {"contact", contact ? nice_length(in_contact.value) : ""},
                     {"others", listed(others)}}}};
}

Findings method_answer(const Facts& facts) {
  const Scene* scene = main_scene(facts.scenes, facts.rows);
  const auto run = scene ? recommended_run(scene->name, recommended_part, facts.rows) : std::nullopt;
  if (!run) return {};
  const double to_percent = 100 / run->motion;
  // state a comparison only if the recommended run is mysim's; the chapter has the other comparisons
  const bool compared = family_of(run->method).is_subject() && !run->beside.empty();
  const auto next = std::ranges::min_element(run->beside, {}, &EngineBeside::times);
  return {{.rule = "answer-method",
           .scene = scene->name,
           .method = run->method,
           .other = compared ? next->engine : "",
           .value = run->error * to_percent,
           .low = std::max(0., run->error - run->error_bar) * to_percent,
           .high = (run->error + run->error_bar) * to_percent,
           .words = {{"setting", setting_of(*run)},
                     {"cpu", step_text(run->cost)},
                     {"duration", step_text(scene->duration)},
                     {"next", compared ? name_in_sentence(next->method) : ""},
                     {"times", compared ? times_text(next->times) : ""}}}};
}

namespace {

/// Counts failures at the scenes' own steps; used if there are no results of experiment `stability`.
Findings failed_runs_answer(std::span<const SceneData> data) {
  size_t failed = 0, all = 0;
  std::vector<std::string> names;
  for (const SceneData& each : data)
    for (const MethodData& m : each.methods) {
      all += m.supported();
      if (!m.supported() || m.ok()) continue;
      ++failed;
      add_once(names, name_in_sentence(m.method));
    }
  if (all == 0) return {};
  return {{.rule = "answer-failed",
           .value = double(failed),
           .words = {{"runs", std::to_string(all)}, {"which", listed(names)}}}};
}

/// Step limit of the main scene in a state, and the agreement of all limits in that state with theory. A limit in the
/// initial state must also be confirmed by the truth, because theory ignores the later states of such a scene.
Findings limit_answer(const Scene& scene, const TableSet& rows, LimitState state) {
  const auto run = recommended_run(scene.name, recommended_part, rows);
  std::optional<LimitRow> shown;
  const std::vector<LimitRow> table = rows_of<LimitRow>(rows);
  for (const LimitRow& row : table)
    if (row.scene == scene.name && row.state == state && row.predicted && row.measured &&
        (state == LimitState::rest || confirmed_by_truth(row)) && family_of(row.method).is_subject() &&
        (!shown || (run && row.method == run->method)))
      shown = row;
  const StepLimitCounts limits = step_limit_counts(table, state);
  if (!shown || limits.agreeing == 0) return {};
  return {{.rule = "answer-limit",
           .method = shown->method,
           .value = *shown->measured,
           .low = shown->held,
           .high = shown->failed,
           .words = {{"where", shown->scene},
                     {"theory", step_text(*shown->predicted)},
                     {"confirmed", std::to_string(limits.agreeing + limits.coarse)},
                     {"all", std::to_string(limits.all())},
                     {"deviation", percent(limits.deviation, 1)}}}};
}

}  // namespace

Findings failure_answer(const Facts& facts) {
  if (const Scene* scene = main_scene(facts.scenes, facts.rows))
    for (const LimitState state : {LimitState::rest, LimitState::start})
      if (Findings answer = limit_answer(*scene, facts.rows, state); !answer.empty()) return answer;
  return failed_runs_answer(facts.data);
}

/// Results on slopes and on the last scene with contact; empty if there are no balls and planes.
Findings ball_answer(const Facts& facts) {
  std::vector<ConeCount> counts = cone_counts(rows_of<ConeRow>(facts.rows));
  const std::vector<ConeCount> planes = cone_counts(plane_cones(facts.rows));
  std::erase_if(counts, [](const ConeCount& c) { return !stands_for_its_engine(c.method); });
  if (std::ranges::none_of(facts.scenes, [](const Scene& s) { return has_contact(s.model); })) counts.clear();
  const SceneData* scene = nullptr;
  for (const SceneData& each : facts.data)
    if (each.touched() && nearest_other(each)) scene = &each;
  const MethodData* other = scene ? nearest_other(*scene) : nullptr;
  bool same_rule = false;
  if (scene)
    for (const MethodData& m : scene->methods)
      if (is_another_engine(m.method) && m.ok() && m.difference && m.same_rule.value_or(false) && !same_rule)
        other = &m, same_rule = true;
  std::string final;
  if (scene)
    if (const Table* over_time = facts.rows.table(scene->scene + "-engines"))
      for (const EngineTimeRow& row : rows_of<EngineTimeRow>(*over_time))
        if (row.method == other->method && row.difference && row.t > scene->window * (1 + 1e-9))
          final = nice_length(*row.difference);
  if (counts.empty() || counts[0].method != ours) {
    if (!scene) return {};
    return {{.rule = "answer-contact",
             .method = ours,
             .other = other->method,
             .value = *other->difference,
             .words = {{"where", scene->scene}, {"until", step_text(scene->window)}, {"final", final}}}};
  }
  // name at most two other methods, those with the most errors
  const ConeCount first = counts[0];
  counts.erase(counts.begin());
  if (counts.size() > 2) std::ranges::stable_sort(counts, {}, &ConeCount::right);
  counts.resize(std::min<size_t>(counts.size(), 2));
  std::vector<std::string> others;
  const auto on_planes = [&](const std::string& method) {
    const ConeCount* count = count_of(planes, method);
    return count ? std::to_string(count->right) : "-";
  };
  for (const ConeCount& count : counts)
    others.push_back(fmt::format("{} {}{}", name_in_sentence(count.method), count.right,
                                 !planes.empty()          ? "/" + on_planes(count.method)
                                 : count.all == first.all ? ""
                                                          : fmt::format("/{}", count.all)));
  return {{.rule = planes.empty() ? "answer-ball" : "answer-ball.planes",
           .method = std::string(subject().name),
           .value = double(first.right),
           .words = {{"cases", std::to_string(first.all)},
                     {"others", fmt::format("{}", fmt::join(others, ", "))},
                     {"planes", on_planes(first.method)},
                     {"drape", same_rule ? scene->scene : ""},
                     {"apart", same_rule ? nice_length(*other->difference) : ""},
                     {"until", same_rule ? step_text(scene->window) : ""},
                     {"final", same_rule ? final : ""}}}};
}

/// Compares implicit Euler with the symplectic rule of mysim that keeps the balance best, on the same scene.
Findings energy_answer(const Facts& facts) {
  std::optional<Finding> best;
  const std::vector<EnergyRow> table = rows_of<EnergyRow>(facts.rows);
  for (const EnergyRow& row : table) {
    const bool shown = std::ranges::any_of(facts.scenes, [&](const Scene& s) { return s.name == row.scene; });
    if (!shown || !family_of(row.method).is_subject() || !row.symplectic || row.verdict != Verdict::ok ||
        !row.closure_claimed || !row.largest_residual || !(row.turned_over.value_or(0) > 0))
      continue;
    const double open = 100 * *row.largest_residual / *row.turned_over;
    if (best && best->value <= open) continue;
    best = Finding{.rule = "answer-energy", .scene = row.scene, .method = row.method, .value = open};
  }
  if (!best) return {};
  best->words = {{"where", best->scene}, {"damping", ""}};
  for (const EnergyRow& row : table)
    if (row.scene == best->scene && row.method == "mysim/implicit-euler" && row.equivalent_drag.value_or(0) > 0)
      best->words["damping"] = fmt::format("{:.2g} per second", *row.equivalent_drag);
  return {*best};
}

Findings model_answer(const Facts& facts) {
  const Scene* scene = main_scene(facts.scenes, facts.rows);
  if (!scene) scene = facts.scenes.empty() ? nullptr : &facts.scenes.back();
  if (!scene) return {};
  std::string one, ten;
  double cost = 1;
  for (const LeastModelRow& least : rows_of<LeastModelRow>(facts.rows)) {
    if (least.scene != scene->name || !least.holds) continue;
    if (least.tolerance_is == ToleranceKind::hundredth_of_motion) one = ingredients_text(least.left_out, 1);
    if (least.tolerance_is == ToleranceKind::tenth_of_motion)
      ten = ingredients_text(least.left_out, 2), cost = least.cost_of_full;
  }
  if (one.empty() || ten.empty()) return {};
  return {{.rule = ten == "nothing" ? "answer-model.none" : "answer-model.some",
           .scene = scene->name,
           .value = 100 * (1 - cost),
           .words = {{"one", one}, {"ten", ten}, {"until", step_text(scene->window)}}}};
}

}  // namespace crosscheck
