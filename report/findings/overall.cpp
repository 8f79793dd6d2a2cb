// Sentences on all scenes together: the first screen of the page.

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/tables/table.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/report_data.h"

namespace crosscheck {
namespace {

void agreement_of_all(const std::vector<Scene>& scenes, const std::vector<SceneData>& facts,
                      std::vector<Finding>& out) {
  std::vector<std::string> same, differing, unknown, contact, alone;
  double worst = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const MethodData* b = facts[i].find(theirs);
    if (!b) {
      continue;  // not run
    } else if (!b->supported()) {
      alone.push_back(scenes[i].name);
    } else if (!b->ok() || !b->difference) {
      continue;
    } else if (facts[i].touched()) {
      contact.push_back(fmt::format("{} on {} (until {:.2g} s; centres of mass {} over the whole run)",
                                    nice_length(*b->difference), scenes[i].name, scenes[i].window,
                                    nice_length(b->centres.value_or(0))));
    } else if (!b->different_law.empty()) {
      continue;  // its own part says why
    } else if (!facts[i].round_off) {
      unknown.push_back(scenes[i].name);
    } else if (same_rule_differs(facts[i])) {
      differing.push_back(fmt::format("{} ({})", scenes[i].name, nice_length(*b->difference)));
    } else {
      same.push_back(scenes[i].name);
      worst = std::max(worst, *b->difference);
    }
  }
  auto add = [&](const char* topic, std::string sentence) {
    out.push_back({"", topic, std::move(sentence), "another engine", "agreement-of-all"});
  };
  if (!differing.empty())
    add("failure",
        fmt::format(
            "mysim and Bullet do NOT agree on {}: the same rule at the same step differs by more than round-off.",
            joined(differing)));
  if (!same.empty())
    add("agreement",
        fmt::format("mysim and Bullet agree: with the same rule (symplectic Euler) and the same step they "
                    "part {} on {}.",
                    worst == 0 ? "not at all" : fmt::format("by at most {} (round-off)", nice_length(worst)),
                    joined(same)));
  if (!contact.empty())
    add("contact", fmt::format("With contact the same rule in both differs by at most {}.", joined(contact)));
  if (!unknown.empty())
    add("failure", "Nothing can be said of agreement on " + joined(unknown) + ": the motion is chaotic.");
  if (!alone.empty())
    add("failure", "Bullet's explicit world cannot model " + joined(alone) + ": their tables of runs say why.");
}

/// The engine with the least error at the scenes' own steps; within 5 %, or within the truth's error bar,
/// engines share the place.
void nearest_of_all(const std::vector<Scene>& scenes, const std::vector<SceneData>& facts, std::vector<Finding>& out) {
  std::vector<std::string> bullet, shared, alone;
  int asked = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const MethodData *a = most_accurate(facts[i], &MethodFamily::is_subject),
                     *b = most_accurate(facts[i], &MethodFamily::is_default_peer);
    if (!(facts[i].motion > 0) || (!a && !b)) continue;
    ++asked;
    if (!b)
      alone.push_back(scenes[i].name);
    else if (a && ties_with(*a, *b, facts[i]) && ties_with(*b, *a, facts[i]))
      shared.push_back(scenes[i].name);
    else if (!a || *b->error < *a->error)
      bullet.push_back(fmt::format("{} ({})", scenes[i].name, b->method));
  }
  if (asked == 0) return;
  const int ours_alone = asked - static_cast<int>(bullet.size() + shared.size());
  std::vector<std::string> parts;
  if (ours_alone > 0)
    parts.push_back(
        fmt::format("mysim on {} scene{}{}", ours_alone, ours_alone == 1 ? "" : "s",
                    alone.empty() ? "" : fmt::format(" (on {} no world of Bullet answers)", joined(alone))));
  if (!bullet.empty()) parts.push_back(fmt::format("Bullet on {}", joined(bullet)));
  if (!shared.empty()) parts.push_back(fmt::format("both, within 5 %, on {}", joined(shared)));
  out.push_back(
      {"", "accuracy",
       fmt::format("Of mysim and Bullet the one with the method nearest to the truth, at the scene's own step, is "
                   "{}; {} scenes have a truth. Rules of higher order, of which Bullet has none, decide most of that.",
                   joined(parts), asked),
       "see each scene", "nearest-of-all"});
}

/// The error of the position-based world, by kind of scene.
void other_law_of_all(const std::vector<Scene>& scenes, const std::vector<SceneData>& facts,
                      std::vector<Finding>& out) {
  std::vector<std::pair<std::string, std::map<double, std::string>>> kinds;  // of each: share of the motion, scene
  for (size_t i = 0; i < scenes.size(); ++i) {
    const MethodData* p = facts[i].find(position_based());
    if (!p || !p->ok() || !p->error || !(facts[i].motion > 0)) continue;
    const std::string kind = scene_class(scenes[i]);
    auto at = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == kind; });
    if (at == kinds.end()) at = kinds.insert(kinds.end(), {kind, {}});
    at->second[*p->error / facts[i].motion] = scenes[i].name;
  }
  const auto told = [](const auto& each) { return fmt::format("{} ({})", percent(each.first, 1), each.second); };
  std::vector<std::string> parts;
  for (const auto& [kind, errors] : kinds)
    parts.push_back(fmt::format("{} {}", kind, range(told(*errors.begin()), told(*errors.rbegin()))));
  if (!parts.empty())
    out.push_back(
        {"", "accuracy",
         fmt::format("Bullet's position-based world has laws of springs and friction of its own. Its error in "
                     "parts of the motion: {}.",
                     joined(parts)),
         "see each scene", "other-law-of-all"});
}

/// Methods that failed where others held, by kind of failure, and scenes on which all failed.
void failures_of_all(const std::vector<SceneData>& facts, std::vector<Finding>& out) {
  std::map<std::string, std::map<std::string, std::vector<std::string>>> failed;  // method, kind, scenes
  std::vector<std::string> all;
  for (const SceneData& scene : facts) {
    std::vector<const MethodData*> fell;
    bool held = false;
    for (const MethodData& m : scene.methods) {
      if (!m.supported()) continue;
      held |= m.ok();
      if (!m.ok()) fell.push_back(&m);
    }
    if (fell.empty()) continue;
    if (!held) all.push_back(scene.scene);
    if (held)
      for (const MethodData* m : fell) failed[m->method][m->failure()].push_back(scene.scene);
  }
  std::vector<std::string> parts;
  for (const auto& [method, kinds] : failed)
    for (const auto& [kind, where] : kinds) parts.push_back(fmt::format("{} {} on {}", method, kind, joined(where)));
  std::string sentence;
  for (const std::string& part : parts) sentence += (sentence.empty() ? "" : "; ") + part;
  if (!sentence.empty())
    out.push_back({"", "failure", fmt::format("{}. Other methods hold there at the same step.", sentence), "measured",
                   "failed-of-all"});
  if (!all.empty())
    out.push_back({"", "failure", fmt::format("No method that was asked comes to the end on {}.", joined(all)),
                   "measured", "failed-of-all"});
}

void orders(const Rows& result, std::vector<Finding>& out) {
  const Table* slopes = result.table("order-slopes");
  if (!slopes || slopes->rows.empty()) return;
  double off = -1;
  std::string which;
  for (size_t i = 0; i < slopes->rows.size(); ++i) {
    const double measured = number_at(*slopes, i, "measured order", NAN);
    const double declared = number_at(*slopes, i, "declared order", NAN);
    if (std::abs(measured - declared) <= off) continue;
    off = std::abs(measured - declared);
    which = fmt::format("{} on {}: {:.2f} instead of {:g}", std::get<std::string>(slopes->at(i, "method")),
                        std::get<std::string>(slopes->at(i, "scene")), measured, declared);
  }
  // 0.1: what the finest three steps of a smooth scene still carry of the next order
  if (off <= 0.1)
    out.push_back(
        {"", "order",
         fmt::format(
             "Measured orders of accuracy lie within {:.2f} of the declared ones; smooth scenes: {}, methods: {}.", off,
             distinct(*slopes, "scene").size(), distinct(*slopes, "method").size()),
         "see each scene", "orders"});
  else
    out.push_back({"", "failure", fmt::format("Not all measured orders of accuracy are the declared ones ({}).", which),
                   "see each scene", "orders"});
}

}  // namespace

std::vector<Finding> disagreement_findings(const Rows& result) {
  const Table* t = result.table("disagreements");
  if (!t || t->rows.empty()) return {};
  std::map<std::string, int> by_world;
  for (size_t i = 0; i < t->rows.size(); ++i) ++by_world[text_at(*t, i, "world")];
  std::vector<std::string> worlds;
  for (const auto& [world, count] : by_world)
    worlds.push_back(fmt::format("{} in {}",
                                 world.find('/') != std::string::npos ? world
                                 : family_of(world).single_precision  ? "single precision"
                                                                      : "all worlds",
                                 count));
  return {{"", "failure",
           fmt::format("Bullet's worlds answer otherwise than a scene asks in {} known ways, each measured in the "
                       "smallest scene that shows it: {}.",
                       t->rows.size(), joined(worlds)),
           "measured", "known-disagreements"}};
}

std::vector<Finding> overall_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& facts,
                                      const Rows& result) {
  std::vector<Finding> out;
  agreement_of_all(scenes, facts, out);
  nearest_of_all(scenes, facts, out);
  other_law_of_all(scenes, facts, out);
  failures_of_all(facts, out);
  orders(result, out);
  const std::pair<const char*, std::vector<Finding> (*)(const Rows&)> table[] = {
      {"speed-accuracy", speed_findings},
      {"stability", stability_findings},
      {"energy", energy_findings},
      {"sphere", sphere_findings},
      {"adequacy", adequacy_findings},
      {"cost", cost_findings},
      {"disagreements", disagreement_findings}};
  for (const auto& [chapter, of_experiment] : table)
    for (Finding& finding : of_experiment(result)) {
      finding.chapter = chapter;
      out.push_back(std::move(finding));
    }
  return out;
}

}  // namespace crosscheck
