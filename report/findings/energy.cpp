#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/matrix.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Largest residual / energy exchanged; nullopt if no energy was exchanged or measured.
std::optional<double> share_of(const EnergyRow& row) {
  if (!(row.turned_over.value_or(0) > 0)) return std::nullopt;
  return row.largest_residual.value_or(0) / *row.turned_over;
}

void symplectic(const std::vector<EnergyRow>& table, Findings& out) {
  double worst = -1;
  long fewest = 0, most = 0;
  size_t bounded = 0, all = 0;
  Findings exceptions;
  for (const EnergyRow& row : table) {
    const auto share = share_of(row);
    if (!row.undamped || !row.closure_claimed || !row.symplectic || !share) continue;
    ++all;
    const std::string what = residual_class(row);
    const bool ok = row.verdict == Verdict::ok;
    if (ok) {
      fewest = worst < 0 ? row.steps : std::min(fewest, row.steps), most = std::max(most, row.steps);
      worst = std::max(worst, *share);
    }
    bounded += ok && is_bounded(what);
    if (!ok || !is_bounded(what))
      exceptions.push_back({.rule = ok ? "symplectic-drift" : "energy-failed.symplectic",
                            .method = row.method,
                            .value = ok ? row.growth.value_or(0) : row.end,
                            .words = {{"where", row.scene}, {"how", what}}});
  }
  if (worst >= 0)
    out.push_back({.rule = "symplectic-energy",
                   .value = 100 * worst,
                   .words = {{"steps", range(count_text(fewest), count_text(most))},
                             {"bounded", std::to_string(bounded)},
                             {"all", std::to_string(all)}}});
  out.insert(out.end(), exceptions.begin(), exceptions.end());
}

/// Failed runs of rules that are not symplectic, and of user programs, on the first undamped scene.
void drift(const std::vector<EnergyRow>& table, Findings& out) {
  std::vector<std::string> shown{subject_method(never_stable_undamped), subject_method(is_implicit)};
  for (const MethodFamily* peer : default_peers()) shown.push_back(position_based(*peer));
  const auto first = std::ranges::find_if(
      table, [](const EnergyRow& row) { return row.undamped && row.closure_claimed && share_of(row); });
  for (const EnergyRow& row : table) {
    const auto share = share_of(row);
    if (first == table.end() || row.scene != first->scene || !share || row.symplectic ||
        (!std::ranges::count(shown, row.method) && family_of(row.method).role != Role::outside))
      continue;
    if (row.verdict != Verdict::ok)
      out.push_back({.rule = "energy-failed",
                     .method = row.method,
                     .value = row.end,
                     .words = {{"where", row.scene}, {"how", failure_class(row.verdict)}}});
  }
}

/// "+1.8 %", or "0 ± 0.45 %" within the error bar.
std::string off_text(double taken, double in_truth, double bar) {
  const double off = std::abs(taken) - std::abs(in_truth);
  if (std::abs(off) <= bar) return "0 ± " + percent(bar, std::abs(in_truth));
  return (off > 0 ? "+" : "−") + percent(std::abs(off), std::abs(in_truth));
}

/// Compares the contact losses of runs with those of the truth: for representatives, and for the method of mysim that
/// deviates most.
void taken_by_contact(const TableSet& rows, Findings& out) {
  const std::vector<EngineEnergyRow> table = rows_of<EngineEnergyRow>(rows);
  std::vector<std::string> scenes;
  for (const EngineEnergyRow& row : table)
    if (row.contact) add_once(scenes, row.scene);
  for (const std::string& scene : scenes) {
    const EngineEnergyRow *first = nullptr, *furthest = nullptr;
    std::vector<const EngineEnergyRow*> others;
    for (const EngineEnergyRow& row : table) {
      if (row.scene != scene || !row.contact || row.verdict != Verdict::ok || row.method == sticky_sphere) continue;
      const auto off = [](const EngineEnergyRow* of) { return std::abs(*of->contact - *of->contact_in_truth); };
      if (row.method == ours) first = &row;
      // mysim's methods need a measured contact energy; inferred from the balance, it would include numerical damping
      if (may_move_alike(row.method)) others.push_back(&row);
      if (!row.contact_inferred && row.method != ours && family_of(row.method).is_subject() &&
          (!furthest || off(&row) > off(furthest)))
        furthest = &row;
    }
    // skip scenes whose truth is too inaccurate to resolve deviations
    if (!first || *first->contact_bar > 0.1 * std::abs(*first->contact_in_truth)) continue;
    if (furthest) others.insert(others.begin(), furthest);
    const double in_truth = *first->contact_in_truth, bar = *first->contact_bar;
    std::vector<std::string> words;
    for (const EngineEnergyRow* row : others)
      words.push_back(fmt::format("{} {}", name_in_sentence(row->method), off_text(*row->contact, in_truth, bar)));
    const auto share = [&](double off) { return 100 * off / std::abs(in_truth); };
    const double off = *first->contact - in_truth;
    // as many digits as the error bar allows
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(bar))), 0, 9);
    out.push_back({.rule = "contact-energy",
                   .scene = scene,
                   .method = ours,
                   .value = share(std::abs(off)),
                   .low = share(std::max(0., std::abs(off) - bar)),
                   .high = share(std::abs(off) + bar),
                   .words = {{"until", step_text(*first->contact_until)},
                             {"taken", fmt::format("{:.{}f}", in_truth, digits)},
                             {"bar", fmt::format("{:.1g}", bar)},
                             {"off", off_text(*first->contact, in_truth, bar)},
                             {"others", fmt::format("{}", fmt::join(words, ", "))}}});
  }
}

void damping(const std::vector<DampingRow>& table, Findings& out) {
  Findings all;
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
      f->words["rate"] = fmt::format("{:.2f}", *row.equivalent_drag * row.step / row.h_omega);
  }
  out.insert(out.end(), all.begin(), all.end());
}

/// Damping that other engines add to an undamped spring; and energy that they gain if the spring is modelled by
/// user-supplied forces.
void damping_of_engines(std::vector<MatrixRow<false>> table, Findings& out) {
  std::erase_if(
      table, [](const MatrixRow<false>& row) { return family_of(row.method).is_subject() || !row.value || !row.bar; });
  std::ranges::stable_sort(table, std::greater(), [](const MatrixRow<false>& row) { return std::abs(*row.value); });
  const MatrixRow<false>* most = nullptr;
  std::vector<std::string> others, none, gains;
  for (const MatrixRow<false>& row : table) {
    const bool zero = std::abs(*row.value) <= *row.bar;
    const std::string name = name_in_sentence(row.method),
                      with_rate = fmt::format("{} {:.2g}", name, std::abs(*row.value));
    if (row.question == EngineQuestion::damping_by_forces && !zero && *row.value < 0) gains.push_back(with_rate);
    if (row.question != EngineQuestion::damping_of_spring) continue;
    if (zero)
      none.push_back(name);
    else if (*row.value > 0 && !most)
      most = &row;
    else if (*row.value > 0)
      others.push_back(with_rate);
  }
  if (most)
    out.push_back({.rule = "engines-damp",
                   .method = most->method,
                   .value = *most->value,
                   .low = *most->value - *most->bar,
                   .high = *most->value + *most->bar,
                   .words = {{"others", fmt::format("{}", fmt::join(others, ", "))},
                             {"none", fmt::format("{}", fmt::join(none, ", "))},
                             {"gains", fmt::format("{}", fmt::join(gains, ", "))}}});
}

}  // namespace

Findings energy_findings(const Facts& facts) {
  Findings out;
  const std::vector<EnergyRow> table = rows_of<EnergyRow>(facts.rows);
  symplectic(table, out);
  drift(table, out);
  taken_by_contact(facts.rows, out);
  damping(rows_of<DampingRow>(facts.rows), out);
  damping_of_engines(rows_of<MatrixRow<false>>(facts.rows), out);
  return out;
}

}  // namespace crosscheck
