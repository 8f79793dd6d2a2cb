// Sentences from facts.
#include "report/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

constexpr auto ours = "mysim/symplectic-euler", theirs = "bullet/deformable-explicit", position_based = "bullet/pbd";

std::string percent(double part, double whole) { return fmt::format("{:.2g} %", 100 * part / whole); }

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i) out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

void agreement(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* b = facts.find(theirs);
  if (!b || !b->ok() || !b->difference) return;
  if (!scene.model.find<Sphere>()) {
    out.push_back(
        {scene.name, "agreement",
         fmt::format(
             "The same rule at the same step gives the same motion: {} and {} part by at most {} in {:.3g} s, where a "
             "perturbation grows {}-fold.",
             ours, theirs, nice_length(*b->difference), scene.window, nice(facts.growth)),
         "another engine"});
    return;
  }
  out.push_back(
      {scene.name, "agreement",
       fmt::format(
           "Until {:.3g} s, {} and {} differ by at most {} (RMS). After that single positions are not compared, "
           "since contact makes them unpredictable; the centres of mass stay within {} over the whole run.",
           scene.window, ours, theirs, nice_length(*b->difference), nice_length(b->centres.value_or(0))),
       "another engine"});
}

void other_law(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* p = facts.find(position_based);
  if (!p || !p->ok()) return;
  if (p->error)
    out.push_back({scene.name, "accuracy",
                   fmt::format("{} differs from the truth by up to {}, {} of the motion: its springs follow another "
                               "law and are solved one "
                               "after the other.",
                               position_based, nice_length(*p->error), percent(*p->error, facts.motion)),
                   facts.tier});
  else if (p->difference)
    out.push_back(
        {scene.name, "accuracy",
         fmt::format(
             "{} differs by up to {} (RMS) until {:.3g} s; both its springs and its friction follow other laws.",
             position_based, nice_length(*p->difference), scene.window),
         "another engine"});
}

void accuracy(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts *best = nullptr, *thrifty = nullptr;
  for (const MethodFacts& m : facts.methods) {
    if (!m.ok() || !m.error || m.method.starts_with("truth/")) continue;
    if (!best || *m.error < *best->error) best = &m;
    const double per_step = static_cast<double>(m.evaluations) * m.step / scene.duration;
    if (per_step < 1.5 && (!thrifty || *m.error < *thrifty->error)) thrifty = &m;
  }
  if (!best) return;
  const double shown = std::max(*best->error, facts.bar);
  std::string sentence =
      fmt::format("Nearest to the truth at this step is {} ({}{} for {:.3g} s of motion)", best->method,
                  *best->error < facts.bar ? "within the error bar of " : "", nice_length(shown), scene.window);
  if (thrifty && thrifty != best)
    sentence += fmt::format("; of those with one force evaluation a step it is {} ({})", thrifty->method,
                            nice_length(*thrifty->error));
  out.push_back({scene.name, "accuracy", sentence + ".", facts.tier});
}

void failures(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  std::vector<std::string> failed;
  for (const MethodFacts& m : facts.methods)
    if (m.supported() && !m.ok()) failed.push_back(fmt::format("{} at {:.3g} s", m.method, m.end));
  if (!failed.empty())
    out.push_back({scene.name, "failure",
                   fmt::format("At a step of {:.3g} s these blew up: {}.", scene.step, joined(failed)), "measured"});
}

/// "0.36 mm inside the contact surface"; what is within round-off of the surface is on it.
std::string depth(double clearance) {
  if (std::abs(clearance) < 1e-12) return "on the contact surface (to round-off)";
  return fmt::format("{} {} the contact surface", nice_length(std::abs(clearance)),
                     clearance < 0 ? "inside" : "outside");
}

void contact(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  if (!scene.model.find<Sphere>()) return;
  std::string parts;
  for (const char* name : {ours, theirs, position_based})
    if (const MethodFacts* m = facts.find(name); m && m->ok() && m->clearance)
      parts += fmt::format("{}{}: {}{}", parts.empty() ? "" : "; ", name, depth(*m->clearance),
                           m->creep ? fmt::format(", creeping at {} mm/s in the end", nice(1000 * *m->creep)) : "");
  if (!parts.empty()) out.push_back({scene.name, "contact", "Deepest point over the run: " + parts + ".", "measured"});
}

void sticky(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts* m = facts.find("mysim/symplectic-euler+sticky");
  if (!m || !m->ok() || !m->centres || !scene.model.find<Sphere>()) return;
  out.push_back({scene.name, "failure",
                 fmt::format("The assignment's sticky sphere, kept for comparison, freezes the cloth where it touches: "
                             "its centre of mass "
                             "is up to {} away from where the cloth slides to.",
                             nice_length(*m->centres)),
                 "another engine"});
}

void cost(const Scene& scene, const SceneFacts& facts, std::vector<Finding>& out) {
  const MethodFacts *a = facts.find(ours), *b = facts.find(theirs), *p = facts.find(position_based);
  // below 50 particles a step takes less than the clock can tell
  if (scene.model.particles.size() < 50 || !a || !a->cpu_per_step || !b || !b->cpu_per_step || !a->ok() || !b->ok())
    return;
  std::string sentence = fmt::format("One step costs {} {} µs of CPU time and {} {:.1f} times as much", ours,
                                     nice(1e6 * *a->cpu_per_step), theirs, *b->cpu_per_step / *a->cpu_per_step);
  if (p && p->ok() && p->cpu_per_step)
    sentence += fmt::format(", {} {:.1f} times", position_based, *p->cpu_per_step / *a->cpu_per_step);
  out.push_back({scene.name, "cost", sentence + " (one run each, one thread).", "measured"});
}

}  // namespace

std::vector<Finding> findings_of(const Scene& scene, const SceneFacts& facts) {
  std::vector<Finding> out;
  for (const auto part : {agreement, accuracy, other_law, failures, contact, sticky, cost}) part(scene, facts, out);
  return out;
}

std::vector<Finding> overall_findings(const std::vector<Scene>& scenes, const std::vector<SceneFacts>& facts,
                                      const Result& result) {
  std::vector<Finding> out;
  std::vector<std::string> same;
  double worst = 0, best_law = 1e300, worst_law = 0, cheapest = 1e300, dearest = 0;
  std::vector<std::string> euler, heun, contact_scenes;
  double rms = 0, centres = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const MethodFacts *a = facts[i].find(ours), *b = facts[i].find(theirs), *p = facts[i].find(position_based);
    const bool sphere = scenes[i].model.find<Sphere>() != nullptr;
    if (b && b->ok() && b->difference && !sphere) {
      same.push_back(scenes[i].name);
      worst = std::max(worst, *b->difference);
    }
    if (b && b->ok() && b->difference && sphere) {
      contact_scenes.push_back(scenes[i].name);
      rms = std::max(rms, *b->difference);
      centres = std::max(centres, b->centres.value_or(0));
    }
    if (p && p->ok() && p->error) {
      best_law = std::min(best_law, *p->error / facts[i].motion);
      worst_law = std::max(worst_law, *p->error / facts[i].motion);
    }
    for (auto [name, list] : {std::pair{"mysim/explicit-euler", &euler}, std::pair{"mysim/trapezoidal", &heun}})
      if (const MethodFacts* m = facts[i].find(name); m && m->supported() && !m->ok()) list->push_back(scenes[i].name);
    if (a && b && a->ok() && b->ok() && a->cpu_per_step && b->cpu_per_step && scenes[i].model.particles.size() >= 50) {
      cheapest = std::min(cheapest, *b->cpu_per_step / *a->cpu_per_step);
      dearest = std::max(dearest, *b->cpu_per_step / *a->cpu_per_step);
    }
  }
  if (!same.empty())
    out.push_back({"", "agreement",
                   fmt::format("mysim and Bullet agree: with the same rule (symplectic Euler) and the same step they "
                               "part by at most {} (round-off) on {}.",
                               nice_length(worst), joined(same)),
                   "another engine"});
  if (!contact_scenes.empty())
    out.push_back(
        {"", "contact",
         fmt::format(
             "With contact they agree to {} (RMS) until 0.3 s after the first touch, and their centres of mass to {} "
             "over the whole run of {}.",
             nice_length(rms), nice_length(centres), joined(contact_scenes)),
         "another engine"});
  if (worst_law > 0)
    out.push_back(
        {"", "accuracy",
         fmt::format("Bullet's position-based world follows another spring law: its error is {} to {} of the motion.",
                     percent(best_law, 1), percent(worst_law, 1)),
         "see each scene"});
  if (!euler.empty() || !heun.empty()) {
    std::string sentence;
    if (!euler.empty()) sentence += "Explicit Euler blew up on " + joined(euler);
    if (!heun.empty())
      sentence +=
          (sentence.empty() ? "The explicit trapezoidal rule blew up on " : "; the explicit trapezoidal rule on ") +
          joined(heun);
    out.push_back({"", "failure", sentence + ", at a step where the other rules are stable.", "measured"});
  }
  if (const Table* slopes = result.table("order-slopes"); slopes && !slopes->rows.empty()) {
    double off = 0;
    for (size_t i = 0; i < slopes->rows.size(); ++i)
      off = std::max(off, std::abs(std::get<double>(slopes->at(i, "measured order")) -
                                   double(std::get<long>(slopes->at(i, "declared order")))));
    out.push_back({"", "order", fmt::format("Measured orders of accuracy lie within {:.2f} of the declared ones.", off),
                   "see each scene"});
  }
  if (dearest > 0)
    out.push_back({"", "cost",
                   fmt::format("One step of the same rule on cloth costs Bullet {:.1f} to {:.1f} times the CPU time of "
                               "mysim's plain loops (Debian's "
                               "build of Bullet; one run each).",
                               cheapest, dearest),
                   "measured"});
  return out;
}

}  // namespace crosscheck
