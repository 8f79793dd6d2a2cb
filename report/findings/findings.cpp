// Sentences from facts.
#include "report/findings/findings.h"

#include <algorithm>
#include <cmath>

#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

void agreement(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  const MethodData* b = facts.find(theirs);
  if (!b || !b->ok() || !b->difference) return;
  const std::string apart = *b->difference == 0 ? "not at all" : "by at most " + nice_length(*b->difference);
  if (facts.touched()) {
    std::string sentence = fmt::format("Until {:.3g} s, {} and {} differ by at most {} (RMS).", scene.window, ours,
                                       theirs, nice_length(*b->difference));
    if (scene.window < scene.duration)
      sentence += fmt::format(
          " Single positions are compared up to there; the centres of mass stay within {} over the whole run.",
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

/// The known cause. It damps as implicit Euler does, and where it errs no more its law is not what is seen.
std::string why_off(const Scene& scene, const SceneData& facts, const MethodData& p) {
  const auto* springs = scene.model.find<Springs>();
  const MethodData* implicit = facts.find("mysim/implicit-euler");
  // 1.3: far below the factors of 3 and more between the scenes where laws differ and where they do not
  if (p.error && implicit && implicit->ok() && implicit->error && *p.error < 1.3 * *implicit->error)
    return fmt::format("about as far as implicit Euler at the same step ({})", nice_length(*implicit->error));
  if (scene.model.find<Constraints>())
    return "it solves hard lengths one after the other, and has a law of springs of its own";
  const bool several = springs->list.size() > 1;
  if (springs->law == SpringLaw::bullet_link)
    return std::string("here its springs follow the scene's law") +
           (several ? ", but are solved one after the other in long steps" : "");
  return std::string("its springs follow another law") + (several ? " and are solved one after the other" : "");
}

void other_law(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  const MethodData* p = facts.find(position_based());
  if (!p || !p->ok() || !scene.model.find<Springs>() || !(facts.motion > 0)) return;
  const std::string why = why_off(scene, facts, *p);
  if (p->error)
    out.push_back({scene.name, "accuracy",
                   fmt::format("{} differs from the truth by up to {}, {} of the motion: {}.", position_based(),
                               nice_length(*p->error), percent(*p->error, facts.motion), why),
                   facts.tier, "other-law"});
  else if (p->difference)
    out.push_back({scene.name, "accuracy",
                   fmt::format("{} differs by up to {} (RMS) until {:.3g} s: {}{}.", position_based(),
                               nice_length(*p->difference), scene.window, why,
                               facts.touched() ? "; its friction follows another law too" : ""),
                   "another engine", "other-law"});
}

/// Names of those that are as near as the nearest (ties_with()), the thriftiest first; of more than three the number
/// that is left.
std::string as_near(const SceneData& facts, const MethodData& best, const std::vector<const MethodData*>& among) {
  std::vector<const MethodData*> near;
  for (const MethodData* m : among)
    if (ties_with(*m, best, facts)) near.push_back(m);
  std::ranges::stable_sort(near, std::less(), [](const MethodData* m) { return m->evaluations; });
  std::vector<std::string> names;
  for (const MethodData* m : near) names.push_back(m->method + (is_adaptive(m->method) ? " by steps of its own" : ""));
  if (names.size() > 3) {
    const size_t left = names.size() - 2;
    names.resize(2);
    names.push_back(fmt::format("{} others", left));
  }
  return joined(names) + (names.size() == 1 ? " (" : ", as near as each other (");
}

void accuracy(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  std::vector<const MethodData*> judged, single_evaluation;
  for (const MethodData& m : facts.methods) {
    if (m.judged()) judged.push_back(&m);
    if (m.judged() && m.single_evaluation(scene)) single_evaluation.push_back(&m);
  }
  const auto nearest_in = [](const auto& all) {
    return *std::ranges::min_element(all, std::less(), [](const MethodData* m) { return *m->error; });
  };
  if (judged.empty() || !(facts.motion > 0)) return;
  const MethodData* best = nearest_in(judged);
  const double shown = std::max(*best->error, facts.error_bar);
  std::string sentence =
      fmt::format("Nearest to the truth at this step: {}{}{} for {:.3g} s of motion)", as_near(facts, *best, judged),
                  *best->error < facts.error_bar ? "within the error bar of " : "", nice_length(shown), scene.window);
  if (!single_evaluation.empty() && !ties_with(*nearest_in(single_evaluation), *best, facts))
    sentence += fmt::format("; of those with one force evaluation a step: {}{})",
                            as_near(facts, *nearest_in(single_evaluation), single_evaluation),
                            nice_length(*nearest_in(single_evaluation)->error));
  out.push_back({scene.name, "accuracy", sentence + ".", facts.tier, "nearest"});
}

/// Differences from the converged in-house contact rule: no errors, as other rules converge to something else.
void converged_contact(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  if (!facts.contact_until) return;
  std::string parts;
  for (const std::string& name : {ours, std::string("mysim/leapfrog"), theirs})
    if (const MethodData* m = facts.find(name); m && m->ok() && m->from_contact)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", name, nice_length(*m->from_contact));
  if (!parts.empty())
    out.push_back({scene.name, "contact",
                   fmt::format("Until {:.3g} s the motion under the in-house contact rule is converged in the step, to "
                               "{}; other rules converge to something else. Differences from it: {}.",
                               *facts.contact_until, nice_length(facts.error_bar), parts),
                   "converged, in-house contact rule", "converged-contact"});
}

void failures(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  std::vector<std::string> failed, held, limits;
  for (const MethodData& m : facts.methods) {
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
  // a long list of names says less than the names that are not in it
  const std::string sentence =
      failed.size() <= 3 || held.empty()
          ? fmt::format("At a step of {} these failed: {}.", own_step_text(scene), joined(failed))
          : fmt::format("At a step of {} {} of {} methods failed; {} came to the end.{}", own_step_text(scene),
                        failed.size(), failed.size() + held.size(), joined(held),
                        limits.empty() ? "" : " By theory the others are stable: " + joined(limits) + ".");
  out.push_back({scene.name, "failure", sentence, "measured", "failed"});
}

/// "0.36 mm inside the contact surface"; what is within round-off of the surface is on it.
std::string depth(double clearance) {
  if (std::abs(clearance) < 1e-12) return "on it (to round-off)";
  return fmt::format("{} {}", nice_length(std::abs(clearance)), clearance < 0 ? "inside" : "outside");
}

void contact(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  if (!facts.touched()) return;
  std::string parts;
  for (const std::string& name : {ours, theirs, position_based()})
    if (const MethodData* m = facts.find(name); m && m->ok() && m->clearance)
      parts += fmt::format("{}{}: {}{}", parts.empty() ? "" : "; ", name, depth(*m->clearance),
                           !m->creep           ? ""
                           : *m->creep < 1e-12 ? ", what touches rests in the end"
                                               : fmt::format(", touching particles slide at {} mm/s in the end",
                                                             nice(1000 * *m->creep)));
  if (!parts.empty())
    out.push_back({scene.name, "contact",
                   "Closest to the contact surface, or deepest inside, over all samples: " + parts + ".", "measured",
                   "clearance"});
}

void sticky(const Scene& scene, const SceneData& facts, std::vector<Finding>& out) {
  const MethodData* m = facts.find(sticky_sphere);
  if (!m || !m->ok() || !m->centres || !facts.touched() || *m->centres < 10 * scene.tolerance) return;
  out.push_back({scene.name, "failure",
                 fmt::format("The assignment's sticky sphere, kept for comparison, freezes what touches it: "
                             "the centre of mass "
                             "is up to {} away from where it moves otherwise.",
                             nice_length(*m->centres)),
                 "another engine", "sticky"});
}

}  // namespace

std::vector<Finding> findings_of(const Scene& scene, const SceneData& facts) {
  std::vector<Finding> out;
  for (const auto part : {agreement, accuracy, other_law, failures, contact, converged_contact, sticky})
    part(scene, facts, out);
  return out;
}

}  // namespace crosscheck
