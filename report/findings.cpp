// Sentences from facts.
#include "report/findings.h"

#include <algorithm>
#include <cmath>

#include "report/findings_text.h"

namespace crosscheck {
namespace {

void agreement(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* b = facts.find(theirs);
  if (!b || !b->ok() || !b->difference) return;
  const std::string apart = *b->difference == 0 ? "not at all" : "by at most " + nice_length(*b->difference);
  if (facts.touched()) {
    std::string sentence = fmt::format("Until {:.3g} s, {} and {} differ by at most {} (RMS).", scene.window, ours,
                                       theirs, nice_length(*b->difference));
    if (scene.window < scene.duration)
      sentence += fmt::format(
          " After that single positions are not compared, since contact makes them unpredictable; the centres of mass "
          "stay "
          "within {} over the whole run.",
          nice_length(b->centres.value_or(0)));
    out.push_back({scene.name, "agreement", sentence, "another engine", "same-rule"});
  } else if (!b->different_law.empty()) {
    out.push_back({scene.name, "agreement",
                   fmt::format("{} and {} part {} in {:.3g} s; they are not the same rule here: {}.", ours, theirs,
                               apart, scene.window, b->different_law),
                   "another engine", "same-rule"});
  } else if (!facts.round_off) {
    out.push_back({scene.name, "failure",
                   fmt::format("Nothing can be said of agreement: within {:.3g} s a perturbation of 1e-10 m grows "
                               "{}-fold, so that two correct "
                               "engines part as well. {} and {} part {}.",
                               scene.window, nice(facts.growth), ours, theirs, apart),
                   "another engine", "same-rule"});
  } else if (same_rule_differs(facts)) {
    out.push_back({scene.name, "failure",
                   fmt::format("The same rule at the same step does NOT give the same motion: {} and {} part {}, and "
                               "only {} would be round-off.",
                               ours, theirs, apart, nice_length(*facts.round_off)),
                   "another engine", "same-rule"});
  } else {
    out.push_back(
        {scene.name, "agreement",
         fmt::format("The same rule at the same step gives the same motion: {} and {} part {} in {:.3g} s, where {}; "
                     "up to {} is "
                     "round-off.",
                     ours, theirs, apart, scene.window, growth_text(facts.growth), nice_length(*facts.round_off)),
         "another engine", "same-rule"});
  }
}

void other_law(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* p = facts.find(position_based);
  const auto* springs = scene.model.find<Springs>();
  if (!p || !p->ok() || !springs || !(facts.motion > 0)) return;
  const char* why = scene.model.find<Constraints>()
                        ? "hard lengths it solves one after the other, and springs by another law"
                    : springs->law == SpringLaw::bullet_link
                        ? "here its springs follow the scene's law, but are solved one after the other in long steps"
                        : "its springs follow another law and are solved one after the other";
  if (p->error)
    out.push_back({scene.name, "accuracy",
                   fmt::format("{} differs from the truth by up to {}, {} of the motion: {}.", position_based,
                               nice_length(*p->error), percent(*p->error, facts.motion), why),
                   facts.tier, "other-law"});
  else if (p->difference)
    out.push_back(
        {scene.name, "accuracy",
         fmt::format("{} differs by up to {} (RMS) until {:.3g} s: {}{}.", position_based, nice_length(*p->difference),
                     scene.window, why, facts.touched() ? "; its friction follows another law too" : ""),
         "another engine", "other-law"});
}

void accuracy(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts *best = nullptr, *thrifty = nullptr;
  for (const MethodFacts& m : facts.methods) {
    if (!m.judged()) continue;
    if (!best || *m.error < *best->error) best = &m;
    if (m.thrifty(scene) && (!thrifty || *m.error < *thrifty->error)) thrifty = &m;
  }
  if (!best || !(facts.motion > 0)) return;
  const double shown = std::max(*best->error, facts.bar);
  std::string sentence =
      fmt::format("Nearest to the truth at this step is {} ({}{} for {:.3g} s of motion)", best->method,
                  *best->error < facts.bar ? "within the error bar of " : "", nice_length(shown), scene.window);
  if (thrifty && thrifty != best)
    sentence += fmt::format("; of those with one force evaluation a step it is {} ({})", thrifty->method,
                            nice_length(*thrifty->error));
  out.push_back({scene.name, "accuracy", sentence + ".", facts.tier, "nearest"});
}

/// Differences from the converged in-house contact rule: no errors, as other rules converge to something else.
void converged_contact(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  if (!facts.contact_until) return;
  std::string parts;
  for (const char* name : {ours, "mysim/leapfrog", theirs})
    if (const MethodFacts* m = facts.find(name); m && m->ok() && m->from_contact)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", name, nice_length(*m->from_contact));
  if (!parts.empty())
    out.push_back({scene.name, "contact",
                   fmt::format("Until {:.3g} s the motion under the in-house contact rule is converged in the step, to "
                               "{}; other rules converge to something else. Differences from it: {}.",
                               *facts.contact_until, nice_length(facts.bar), parts),
                   "converged, in-house contact rule", "converged-contact"});
}

void failures(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  std::vector<std::string> failed, held, limits;
  for (const MethodFacts& m : facts.methods) {
    if (!m.supported()) continue;
    if (m.ok()) held.push_back(m.method);
    if (m.ok()) continue;
    std::string text = fmt::format("{} at {:.3g} s", m.method, m.end);
    if (m.limit && *m.limit < m.step) {
      const std::string limit = *m.limit > 0 ? "up to a step of " + step_text(*m.limit) : "at no step";
      text += fmt::format(" (stable {} by theory)", limit);
      limits.push_back(fmt::format("{} {}", m.method, limit));
    }
    failed.push_back(text);
  }
  if (failed.empty()) return;
  // a long list of names tells less than who is left
  const std::string sentence =
      failed.size() <= 3 || held.empty()
          ? fmt::format("At a step of {} these failed: {}.", step_text(scene.step), joined(failed))
          : fmt::format("At a step of {} {} of {} methods failed; {} came to the end.{}", step_text(scene.step),
                        failed.size(), failed.size() + held.size(), joined(held),
                        limits.empty() ? "" : " By theory the others are stable: " + joined(limits) + ".");
  out.push_back({scene.name, "failure", sentence, "measured", "failed"});
}

/// "0.36 mm inside the contact surface"; what is within round-off of the surface is on it.
std::string depth(double clearance) {
  if (std::abs(clearance) < 1e-12) return "on the contact surface (to round-off)";
  return fmt::format("{} {} the contact surface", nice_length(std::abs(clearance)),
                     clearance < 0 ? "inside" : "outside");
}

void contact(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  if (!facts.touched()) return;
  std::string parts;
  for (const char* name : {ours, theirs, position_based})
    if (const MethodFacts* m = facts.find(name); m && m->ok() && m->clearance)
      parts += fmt::format(
          "{}{}: {}{}", parts.empty() ? "" : "; ", name, depth(*m->clearance),
          m->creep ? fmt::format(", touching particles slide at {} mm/s in the end", nice(1000 * *m->creep)) : "");
  if (!parts.empty())
    out.push_back({scene.name, "contact", "Nearest to the contact surface at any sample: " + parts + ".", "measured",
                   "clearance"});
}

void sticky(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* m = facts.find(sticky_sphere);
  if (!m || !m->ok() || !m->centres || !facts.touched() || *m->centres < 10 * scene.tolerance) return;
  out.push_back({scene.name, "failure",
                 fmt::format("The assignment's sticky sphere, kept for comparison, freezes what touches it: "
                             "the centre of mass "
                             "is up to {} away from where it moves otherwise.",
                             nice_length(*m->centres)),
                 "another engine", "sticky"});
}

void cost(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts *a = facts.find(ours), *b = facts.find(theirs), *p = facts.find(position_based);
  if (!costs_compare(scene) || !a || !a->cpu_per_step || !b || !b->cpu_per_step || !a->ok() || !b->ok()) return;
  std::string sentence = fmt::format("One step costs {} {} µs of CPU time and {} {:.1f} times as much", ours,
                                     nice(1e6 * *a->cpu_per_step), theirs, *b->cpu_per_step / *a->cpu_per_step);
  if (p && p->ok() && p->cpu_per_step)
    sentence += fmt::format(", {} {:.1f} times", position_based, *p->cpu_per_step / *a->cpu_per_step);
  out.push_back(
      {scene.name, "cost",
       sentence + " (one run each, one thread, watched at every step; the chapter on cost times steps alone).",
       "measured", "step-cost"});
}

}  // namespace

std::vector<Finding> findings_of(const Scene& scene, const SceneFacts& facts) {
  std::vector<Finding> out;
  for (const auto part : {agreement, accuracy, other_law, failures, contact, converged_contact, sticky, cost})
    part(scene, facts, out);
  return out;
}

}  // namespace crosscheck
