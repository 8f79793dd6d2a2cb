#include "report/findings/findings.h"

#include <algorithm>
#include <cmath>

#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// Compares another engine's method with mysim's representative.
Finding agreement_with(const MethodData& b, const Scene& scene, const SceneData& data) {
  Finding f{.rule = "same-rule",
            .method = ours,
            .other = b.method,
            .value = *b.difference,
            .words = {{"window", step_text(scene.window)},
                      {"bound", b.round_off_bound ? nice_length(*b.round_off_bound) : ""}}};
  if (!b.same_rule) {
    const bool round_off = b.round_off_bound && !data.touched() && f.value <= *b.round_off_bound;
    f.rule = round_off ? "same-rule.same-motion" : "same-rule.unknown";
  } else if (*b.same_rule && data.touched()) {
    f.rule = "same-rule.contact";
  } else if (!*b.same_rule || !b.different_law.empty()) {
    f.rule = "same-rule.different";
  } else if (!b.round_off_bound) {
    f.rule = "chaotic", f.value = data.growth, f.words["apart"] = nice_length(*b.difference);
  } else if (same_rule_differs(data, b)) {
    f.rule = "same-rule.differs";
  }
  return f;
}

void agreement(const Scene& scene, const SceneData& data, Findings& out) {
  for (const MethodData& b : data.methods)
    if (b.ok() && b.difference && may_move_alike(b.method)) out.push_back(agreement_with(b, scene, data));
}

/// The cheapest method with an error below the truth's error bar, or at most 5 % above the smallest error.
void nearest(const Scene& scene, const SceneData& data, Findings& out) {
  std::vector<MethodData> tied = data.methods;
  std::erase_if(tied, [](const MethodData& m) { return !m.judged(); });
  if (tied.empty() || !(data.motion > 0)) return;
  const double least = *std::ranges::min(tied, {}, &MethodData::error).error;
  std::erase_if(tied, [&](const MethodData& m) { return *m.error > std::max(1.05 * least, data.error_bar); });
  std::ranges::stable_sort(tied, {}, &MethodData::evaluations);
  const MethodData& chosen = tied[0];
  std::vector<std::string> others;
  for (size_t i = 1; i < tied.size(); ++i) others.push_back(name_in_sentence(tied[i].method));
  // errors below the truth's error bar are unknown
  const double error = std::max(*chosen.error, data.error_bar);
  out.push_back({.rule = "nearest",
                 .method = chosen.method,
                 .value = error,
                 .low = std::max(0., *chosen.error - data.error_bar),
                 .high = *chosen.error + data.error_bar,
                 .tier = data.tier,
                 .words = {{"off", (*chosen.error < data.error_bar ? "< " : "") + nice_length(error)},
                           {"window", step_text(std::min(scene.window, data.truth_until.value_or(scene.window)))},
                           {"others", listed(others)}}});
}

void failures(const SceneData& data, Findings& out) {
  size_t all = 0, failed = 0;
  const MethodData* first = nullptr;
  for (const MethodData& m : data.methods) {
    all += m.supported();
    if (!m.supported() || m.ok()) continue;
    ++failed;
    if (!first || m.end < first->end) first = &m;
  }
  if (!first) return;
  out.push_back(
      {.rule = "failed",
       .method = first->method,
       .value = double(failed),
       .words = {
           {"step", step_text(first->step)},
           {"methods", std::to_string(all)},
           {"end", step_text(first->end)},
           {"limit", first->step_limit && *first->step_limit < first->step ? step_text(*first->step_limit) : ""}}});
}

/// Differences from the limit of mysim's contact rule. They are not called errors, because other contact rules
/// converge to other motions.
void converged_contact(const SceneData& data, Findings& out) {
  if (!data.contact_until) return;
  const std::string of_second_order = subject_method(is_symplectic_of_second_order);
  for (const MethodData& m : data.methods)
    if (m.ok() && m.contact_difference && (m.method == of_second_order || stands_for_its_engine(m.method)) &&
        m.method != position_based(family_of(m.method)))
      out.push_back({.rule = "converged-contact",
                     .method = m.method,
                     .value = *m.contact_difference,
                     .low = std::max(0., *m.contact_difference - data.error_bar),
                     .high = *m.contact_difference + data.error_bar,
                     .words = {{"window", step_text(*data.contact_until)}}});
}

void sticky(const Scene& scene, const SceneData& data, Findings& out) {
  const MethodData* m = data.find(sticky_sphere);
  if (m && m->ok() && m->centre_difference && data.touched() && *m->centre_difference >= 10 * scene.tolerance)
    out.push_back({.rule = "sticky", .method = m->method, .other = ours, .value = *m->centre_difference});
}

}  // namespace

Findings scene_findings(const Facts& facts) {
  Findings out;
  agreement(*facts.scene, *facts.of, out);
  nearest(*facts.scene, *facts.of, out);
  failures(*facts.of, out);
  converged_contact(*facts.of, out);
  sticky(*facts.scene, *facts.of, out);
  for (Finding& f : out) f.scene = facts.scene->name;
  return out;
}

}  // namespace crosscheck
