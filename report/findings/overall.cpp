// Findings across all scenes on failures, orders and invariants.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/check.h"
#include "experiments/tables/order.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

/// Methods that failed where others did not, programs without a result, and scenes on which all methods failed.
Findings failure_findings(const Facts& facts) {
  std::map<std::string, std::vector<std::string>> failed, crashed;
  std::vector<std::string> all;
  for (const SceneData& scene : facts.data) {
    const bool held = std::ranges::any_of(scene.methods, &MethodData::ok),
               ran = std::ranges::any_of(scene.methods, &MethodData::supported);
    if (ran && !held) all.push_back(scene.scene);
    for (const MethodData& m : scene.methods)
      if (held && m.supported() && !m.ok()) (m.gave_no_answer() ? crashed : failed)[m.method].push_back(scene.scene);
  }
  Findings out;
  const auto add = [&](const char* rule, const std::string& method, const std::vector<std::string>& where) {
    out.push_back({.rule = rule, .method = method, .value = double(where.size()), .words = {{"where", listed(where)}}});
  };
  for (const auto& [method, where] : crashed) add("failed-of-all.crashed", method, where);
  for (const auto& [method, where] : failed) add("failed-of-all", method, where);
  if (!all.empty()) add("failed-of-all.everywhere", "", all);
  return out;
}

Findings order_findings(const Facts& facts) {
  std::vector<OrderSlopeRow> slopes = rows_of<OrderSlopeRow>(facts.rows);
  std::erase_if(slopes, [](const OrderSlopeRow& row) { return !row.declared_order; });
  if (slopes.empty()) return {};
  const auto off = [](const OrderSlopeRow& row) { return std::abs(row.measured_order - double(*row.declared_order)); };
  const OrderSlopeRow& worst = *std::ranges::max_element(slopes, {}, off);
  std::vector<std::string> methods, scenes;
  for (const OrderSlopeRow& row : slopes) {
    add_once(methods, row.method), add_once(scenes, row.scene);
  }
  // 0.1 allows for the next order's contribution to the finest three steps on a smooth scene
  const bool differs = off(worst) > 0.1;
  return {{.rule = differs ? "orders.differ" : "orders.agree",
           .method = differs ? worst.method : "",
           .value = off(worst),
           .words = {{"methods", std::to_string(methods.size())},
                     {"scenes", std::to_string(scenes.size())},
                     {"where", worst.scene},
                     {"order", fmt::format("{:.2f}", worst.measured_order)},
                     {"declared", std::to_string(*worst.declared_order)}}}};
}

/// Counts the invariants that hold for each engine's methods. Violations without a known cause are a separate finding.
Findings relation_findings(const Facts& facts) {
  struct Counts {
    size_t asked = 0, held = 0, known = 0;
    std::vector<std::string> broken;  // names of relations
  };
  std::vector<std::pair<std::string, Counts>> engines;
  for (const RelationRow& row : rows_of<RelationRow>(facts.rows)) {
    if (row.mark == RelationMark::not_applicable) continue;
    const std::string name = engine_of(row.method);
    auto at = std::ranges::find(engines, name, &std::pair<std::string, Counts>::first);
    if (at == engines.end()) at = engines.insert(at, {name, {}});
    Counts& counts = at->second;
    ++counts.asked, counts.held += row.mark == RelationMark::holds;
    counts.known += row.mark == RelationMark::known;
    if (row.mark == RelationMark::broken) add_once(counts.broken, row.relation);
  }
  Findings out;
  for (const auto& [engine, counts] : engines) {
    out.push_back({.rule = "relations",
                   .method = engine,
                   .value = double(counts.held),
                   .words = {{"asked", std::to_string(counts.asked)},
                             {"known", counts.known > 0 ? std::to_string(counts.known) : ""}}});
    if (!counts.broken.empty())
      out.push_back({.rule = "relations-broken",
                     .method = engine,
                     .value = double(counts.broken.size()),
                     .words = {{"which", listed(counts.broken)}}});
  }
  return out;
}

}  // namespace crosscheck
