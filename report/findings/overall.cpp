// Findings of all scenes together: the answers first, then those of each chapter.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/disagreements/disagreements.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/check.h"
#include "experiments/tables/disagreements.h"
#include "experiments/tables/order.h"
#include "report/findings/answers.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

using Scenes = std::vector<SceneData>;

/// Agreement with the peers on all scenes beside what the answer says of it.
void agreement_of_all(const Scenes& scenes, std::vector<Finding>& out) {
  for (const MethodFamily* peer : default_peers()) {
    const std::string its(peer->representative), name(peer->name);
    std::vector<std::string> chaotic, alone;
    const SceneData* worst = nullptr;
    for (const SceneData& scene : scenes) {
      const MethodData* b = scene.find(its);
      if (!b) continue;
      if (!b->supported()) alone.push_back(scene.scene);
      if (!b->ok() || !b->difference || !b->same_rule.value_or(false)) continue;
      if (scene.touched())
        worst = worst && *worst->find(its)->difference >= *b->difference ? worst : &scene;
      else if (!b->round_off && b->different_law.empty())
        chaotic.push_back(scene.scene);
    }
    if (worst)
      out.push_back({.rule = "contact-of-all",
                     .method = ours,
                     .other = name,
                     .value = *worst->find(its)->difference,
                     .words = {{"where", worst->scene}}});
    for (const auto& [rule, where, other] :
         {std::tuple{"chaotic", chaotic, name}, std::tuple{"cannot", alone, std::string()}})
      if (!where.empty())
        out.push_back({.rule = rule,
                       .method = its,
                       .other = other,
                       .value = static_cast<double>(where.size()),
                       .words = {{"where", listed(where)}}});
  }
}

/// Names in the order in which they first come, each with a list.
using Lists = std::vector<std::pair<std::string, std::vector<std::string>>>;
std::vector<std::string>& list_of(Lists& lists, const std::string& name) {
  const auto at = std::ranges::find(lists, name, &Lists::value_type::first);
  return at != lists.end() ? at->second : lists.insert(lists.end(), {name, {}})->second;
}

/// The engines with the least error at the scenes' own steps; within 5 %, or within the truth's error bar, they share
/// the place.
void nearest_of_all(const Scenes& scenes, std::vector<Finding>& out) {
  Lists won;
  size_t compared = 0;
  for (const SceneData& scene : scenes) {
    const MethodData* best = most_accurate(scene);
    if (!best || !(scene.motion > 0)) continue;
    ++compared;
    for (const MethodData& m : scene.methods) {
      if (!m.judged()) continue;
      auto& where = list_of(won, engine_of(m.method));  // also of those that win nowhere
      if (ties_with(m, *best, scene) && (where.empty() || where.back() != scene.scene)) where.push_back(scene.scene);
    }
  }
  if (won.size() < 2) return;
  for (const auto& [engine, where] : won)
    out.push_back({.rule = "nearest-of-all",
                   .method = engine,
                   .value = static_cast<double>(where.size()),
                   .words = {{"scenes", counted(compared, "scene")}}});
}

/// The error of the peers' position-based methods.
void other_law_of_all(const Scenes& scenes, std::vector<Finding>& out) {
  for (const MethodFamily* peer : default_peers()) {
    Finding f{.rule = "other-law-of-all", .method = position_based(*peer), .value = -1};
    for (const SceneData& scene : scenes) {
      const MethodData* p = scene.find(f.method);
      if (!p || !p->ok() || !p->error || !(scene.motion > 0)) continue;
      const double part = 100 * *p->error / scene.motion;
      f.low = std::min(f.low.value_or(part), part);
      if (part > f.value) f.value = part, f.words = {{"where", scene.scene}};
    }
    f.high = f.value;
    if (f.low) out.push_back(f);
  }
}

/// Methods that failed where others held, and scenes on which all failed.
void failures_of_all(const Scenes& scenes, std::vector<Finding>& out) {
  std::map<std::string, std::vector<std::string>> failed, crashed;
  std::vector<std::string> all;
  for (const SceneData& scene : scenes) {
    const bool held = std::ranges::any_of(scene.methods, &MethodData::ok),
               ran = std::ranges::any_of(scene.methods, &MethodData::supported);
    if (ran && !held) all.push_back(scene.scene);
    for (const MethodData& m : scene.methods)
      if (held && m.supported() && !m.ok()) (m.gave_no_answer() ? crashed : failed)[m.method].push_back(scene.scene);
  }
  // of the program, which says nothing of its physics
  for (const auto& [method, where] : crashed)
    out.push_back({.rule = "crashed-of-all",
                   .method = method,
                   .value = static_cast<double>(where.size()),
                   .words = {{"where", listed(where)}}});
  for (const auto& [method, where] : failed)
    out.push_back({.rule = "failed-of-all",
                   .method = method,
                   .value = static_cast<double>(where.size()),
                   .words = {{"where", listed(where)}}});
  if (!all.empty())
    out.push_back(
        {.rule = "failed-everywhere", .value = static_cast<double>(all.size()), .words = {{"where", listed(all)}}});
}

void orders(const TableSet& rows, std::vector<Finding>& out) {
  std::vector<OrderSlopeRow> slopes = rows_of<OrderSlopeRow>(rows);
  std::erase_if(slopes, [](const OrderSlopeRow& row) { return !row.declared_order; });
  if (slopes.empty()) return;
  const auto off = [](const OrderSlopeRow& row) {
    return std::abs(row.measured_order - static_cast<double>(*row.declared_order));
  };
  const OrderSlopeRow& worst = *std::ranges::max_element(slopes, {}, off);
  Lists methods, scenes;
  for (const OrderSlopeRow& row : slopes) list_of(methods, row.method), list_of(scenes, row.scene);
  // 0.1: what the finest three steps of a smooth scene still carry of the next order
  if (off(worst) <= 0.1)
    out.push_back({.rule = "orders",
                   .value = off(worst),
                   .words = {{"off", fmt::format("{:.2f}", std::max(0.01, off(worst)))},
                             {"methods", counted(methods.size(), "method")},
                             {"scenes", counted(scenes.size(), "smooth scene")}}});
  else
    out.push_back({.rule = "orders-differ",
                   .method = worst.method,
                   .value = worst.measured_order,
                   .words = {{"off", fmt::format("{:.2f}", worst.measured_order)},
                             {"declared", std::to_string(*worst.declared_order)},
                             {"where", worst.scene}}});
}

/// By engine: a row names one of its worlds, or those of several.
void disagreements(const TableSet& rows, std::vector<Finding>& out) {
  std::map<std::string, size_t> by_engine;
  for (const DisagreementRow& row : rows_of<DisagreementRow>(rows))
    if (row.state == name_of(TroubleState::explained) || row.state == name_of(TroubleState::reproduced))
      ++by_engine[engine_of(row.world)];
  for (const auto& [engine, count] : by_engine)
    out.push_back({.rule = "known-disagreements",
                   .method = engine,
                   .value = static_cast<double>(count),
                   .words = {{"ways", counted(count, "known way")}}});
}

/// What holds in an engine without any truth, over all its methods; a break without a known cause is a finding.
void relations_of_engines(const TableSet& rows, std::vector<Finding>& out) {
  struct Counts {
    size_t asked = 0, held = 0;
    std::vector<std::string> broken;  // names of relations
  };
  std::vector<std::pair<std::string, Counts>> engines;
  for (const RelationRow& row : rows_of<RelationRow>(rows)) {
    if (row.mark == RelationMark::not_asked) continue;
    const std::string name = engine_of(row.method);
    auto at = std::ranges::find(engines, name, &std::pair<std::string, Counts>::first);
    if (at == engines.end()) at = engines.insert(at, {name, {}});
    Counts& counts = at->second;
    ++counts.asked, counts.held += row.mark == RelationMark::holds;
    if (row.mark == RelationMark::broken && std::ranges::find(counts.broken, row.relation) == counts.broken.end())
      counts.broken.push_back(row.relation);
  }
  for (const auto& [engine, counts] : engines) {
    const std::string rest = counts.held == counts.asked ? ""
                             : counts.broken.empty()     ? ", and the others break for known causes"
                                                         : "";
    out.push_back({.rule = "relations",
                   .method = engine,
                   .value = static_cast<double>(counts.held),
                   .words = {{"asked", counted(counts.asked, "question")}, {"rest", rest}}});
    if (!counts.broken.empty())
      out.push_back({.rule = "relations-broken",
                     .method = engine,
                     .value = static_cast<double>(counts.broken.size()),
                     .words = {{"which", listed(counts.broken)}}});
  }
}

}  // namespace

std::vector<Finding> overall_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& data,
                                      const TableSet& rows) {
  std::vector<Finding> out = answer_findings(scenes, data, rows);
  for (const auto of_scenes : {agreement_of_all, nearest_of_all, other_law_of_all, failures_of_all})
    of_scenes(data, out);
  orders(rows, out);
  for (const auto of_experiment :
       {speed_findings, stability_findings, energy_findings, sphere_findings, adequacy_findings, cost_findings})
    for (Finding& f : of_experiment(rows)) out.push_back(std::move(f));
  disagreements(rows, out);
  relations_of_engines(rows, out);
  for (Finding& f : stiffness_findings(rows)) out.push_back(std::move(f));
  return out;
}

}  // namespace crosscheck
