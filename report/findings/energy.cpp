// Findings of experiment `energy`.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// The largest residual in parts of the energy turned over; nothing at rest, or where it was left out.
std::optional<double> share_of(const EnergyRow& row) {
  if (!(row.turned_over.value_or(0) > 0)) return std::nullopt;
  return row.largest_residual.value_or(0) / *row.turned_over;
}

/// Symplectic rules on the undamped scenes.
void symplectic(const std::vector<EnergyRow>& table, std::vector<Finding>& out) {
  double worst = -1;
  long fewest = 0, most = 0;
  size_t drifting = 0;
  std::vector<Finding> exceptions;
  for (const EnergyRow& row : table) {
    const auto share = share_of(row);
    if (!row.undamped || !row.closure_claimed || !row.symplectic || !share) continue;
    const std::string what = residual_class(row);
    if (row.verdict != Verdict::ok) {
      exceptions.push_back({.rule = "symplectic-failed",
                            .method = row.method,
                            .value = row.end,
                            .words = {{"where", row.scene}, {"how", what}}});
      continue;
    }
    fewest = worst < 0 ? row.steps : std::min(fewest, row.steps), most = std::max(most, row.steps);
    worst = std::max(worst, *share);
    if (is_bounded(what)) continue;
    ++drifting;
    exceptions.push_back({.rule = "symplectic-drift",
                          .method = row.method,
                          .value = row.growth.value_or(0),
                          .words = {{"where", row.scene}, {"how", what}}});
  }
  if (worst >= 0)
    out.push_back({.rule = "symplectic-energy",
                   .value = 100 * worst,
                   .words = {{"steps", range(count_text(fewest), count_text(most))},
                             {"drift", drifting == 0 ? ", without drift" : ""}}});
  out.insert(out.end(), exceptions.begin(), exceptions.end());
}

/// Rules that are not symplectic, on the first undamped scene: those that are position-based, stable at no step, or
/// implicit, and programs of the reader's.
void drift(const std::vector<EnergyRow>& table, std::vector<Finding>& out) {
  std::vector<std::string> shown{subject_method(never_stable_undamped), subject_method(is_implicit)};
  for (const MethodFamily* peer : default_peers()) shown.push_back(position_based(*peer));
  const auto first = std::ranges::find_if(
      table, [](const EnergyRow& row) { return row.undamped && row.closure_claimed && share_of(row); });
  for (const EnergyRow& row : table) {
    const auto share = share_of(row);
    if (first == table.end() || row.scene != first->scene || !share || row.symplectic ||
        (!std::ranges::count(shown, row.method) && family_of(row.method).role != Role::outside))
      continue;
    Finding f{.rule = "energy-adds", .method = row.method, .value = 100 * *share};
    f.words = {{"where", row.scene}, {"step", step_text(row.step)}};
    if (row.verdict != Verdict::ok)
      f.rule = "energy-failed", f.value = row.end, f.words["how"] = failure_class(row.verdict);
    else if (row.residual.value_or(0) < 0 && row.equivalent_drag.value_or(0) > 0)
      f.rule = "energy-damps", f.value = *row.equivalent_drag;
    out.push_back(f);
  }
}

/// How far the balance of symplectic rules stays open where drag or contact act, in parts of their energy.
void open_balances(const std::vector<EnergyRow>& table, std::vector<Finding>& out) {
  std::map<std::string, Finding> by_scene;
  for (const EnergyRow& row : table) {
    const double took =
        std::abs(row.drag.value_or(0)) + std::abs(row.dashpots.value_or(0)) + std::abs(row.contact.value_or(0));
    if (row.undamped || !row.symplectic || !row.closure_claimed || row.verdict != Verdict::ok ||
        row.method == sticky_sphere || !(took > 0))
      continue;
    const double open = 100 * row.largest_residual.value_or(0) / took;
    Finding& f = by_scene.try_emplace(row.scene, Finding{.rule = "open-balance", .value = -1}).first->second;
    f.low = std::min(f.low.value_or(open), open);
    if (open > f.value) f.value = open, f.high = open, f.method = row.method, f.words = {{"where", row.scene}};
  }
  for (const auto& [scene, finding] : by_scene) out.push_back(finding);
}

/// "1.8 % more", "5.8 % less", "as much" where the error bar hides the difference.
std::string off_text(double taken, double in_truth, double bar) {
  const double off = taken - in_truth;
  if (std::abs(off) <= bar) return "as much";
  return fmt::format("{} {}", percent(std::abs(off), std::abs(in_truth)), off * in_truth > 0 ? "more" : "less");
}

/// What contact takes on scenes whose truth says it: of the methods that stand for the engines, and of mysim's the one
/// that is furthest off.
void taken_by_contact(const TableSet& rows, std::vector<Finding>& out) {
  const std::vector<EngineEnergyRow> table = rows_of<EngineEnergyRow>(rows);
  std::vector<std::string> scenes;
  for (const EngineEnergyRow& row : table)
    if (row.contact && std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
  for (const std::string& scene : scenes) {
    const EngineEnergyRow *first = nullptr, *furthest = nullptr;
    std::vector<const EngineEnergyRow*> others;
    for (const EngineEnergyRow& row : table) {
      if (row.scene != scene || !row.contact || row.verdict != Verdict::ok || row.method == sticky_sphere) continue;
      const auto off = [](const EngineEnergyRow* of) { return std::abs(*of->contact - *of->contact_in_truth); };
      if (row.method == ours) first = &row;
      // what an engine does not tell is what its balance lacks, and of a rule that damps by itself more than contact
      if (is_another_engine(row.method) && stands_for_its_engine(row.method) &&
          row.method != position_based(family_of(row.method)))
        others.push_back(&row);
      if (!row.contact_inferred && row.method != ours && (!furthest || off(&row) > off(furthest))) furthest = &row;
    }
    // a tenth: beyond that the truth knows no share of it
    if (!first || *first->contact_bar > 0.1 * std::abs(*first->contact_in_truth)) continue;
    if (furthest) others.insert(others.begin(), furthest);
    const double in_truth = *first->contact_in_truth, bar = *first->contact_bar;
    std::string words;
    for (const EngineEnergyRow* row : others)
      words += fmt::format(", {} {}", name_in_sentence(row->method), off_text(*row->contact, in_truth, bar));
    const auto share = [&](double off) { return 100 * off / std::abs(in_truth); };
    const double off = *first->contact - in_truth;
    // as many digits as the bar allows
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(bar))), 0, 9);
    out.push_back({.rule = "contact-energy",
                   .scene = scene,
                   .method = ours,
                   .value = share(std::abs(off)),
                   .low = share(std::max(0., std::abs(off) - bar)),
                   .high = share(std::abs(off) + bar),
                   .words = {{"until", step_text(*first->contact_until)},
                             {"takes", fmt::format("{} {:.{}f} ± {:.1g} J", in_truth < 0 ? "gives" : "takes",
                                                   std::abs(in_truth), digits, bar)},
                             {"off", off_text(*first->contact, in_truth, bar)},
                             {"others", words}}});
  }
}

/// Numerical damping against the closed form.
void damping(const std::vector<DampingRow>& table, std::vector<Finding>& out) {
  std::vector<Finding> all;
  for (const DampingRow& row : table) {
    const Method* m = builtin_method(row.method);
    if (!m || (m->on_one_spring.empty() ? m->rule : m->on_one_spring) != "implicit-euler" ||
        !(row.by_theory.value_or(0) > 0) || !row.equivalent_drag || !std::isfinite(*row.equivalent_drag))
      continue;
    auto f = std::ranges::find(all, row.method, &Finding::method);
    if (f == all.end())
      f = all.insert(all.end(), {.rule = "numerical-damping", .method = row.method, .words = {{"rate", ""}}});
    f->value = std::max(f->value, 100 * std::abs(*row.equivalent_drag / *row.by_theory - 1));
    if (std::abs(row.h_omega - 0.1) < 1e-9)
      f->words["rate"] =
          fmt::format(", like a drag of {:.2f} ω at hω = 0.1", *row.equivalent_drag * row.step / row.h_omega);
  }
  out.insert(out.end(), all.begin(), all.end());
}

}  // namespace

std::vector<Finding> energy_findings(const TableSet& rows) {
  std::vector<Finding> out;
  const std::vector<EnergyRow> table = rows_of<EnergyRow>(rows);
  for (const auto part : {symplectic, drift, open_balances}) part(table, out);
  taken_by_contact(rows, out);
  damping(rows_of<DampingRow>(rows), out);
  return out;
}

}  // namespace crosscheck
