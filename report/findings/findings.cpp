// Findings of one scene.
#include "report/findings/findings.h"

#include <algorithm>
#include <cmath>

#include "experiments/speed_accuracy/work_precision.h"
#include "report/findings/findings_text.h"
#include "report/findings/recommendation.h"

namespace crosscheck {
namespace {

/// A scene's findings so far.
struct Said {
  const Scene& scene;
  const SceneData& data;
  std::vector<Finding> out = {};
  void add(Finding f) {
    f.scene = scene.name;
    out.push_back(std::move(f));
  }
  std::string window() const { return step_text(scene.window); }
  std::string share(double metres) const { return percent(metres, data.motion); }
};

void agreement_with(const MethodData& b, Said& said) {
  const SceneData& data = said.data;
  Finding f{.rule = "same-rule",
            .method = ours,
            .other = b.method,
            .value = *b.difference,
            .words = {{"window", said.window()}}};
  if (!b.same_rule) {
    const bool round_off = b.round_off && !data.touched() && f.value <= *b.round_off;
    f.rule = round_off ? "same-motion" : "unknown-rule";
    if (round_off) f.words["bound"] = nice_length(*b.round_off);
  } else if (*b.same_rule && data.touched()) {
    f.rule = "same-rule-contact";
  } else if (!*b.same_rule || !b.different_law.empty()) {
    f.rule = "different-rule";
  } else if (!b.round_off) {
    f.rule = "same-rule-chaotic", f.value = data.growth, f.words["apart"] = nice_length(*b.difference);
  } else {
    f.words["bound"] = nice_length(*b.round_off);
    if (same_rule_differs(data, b)) f.rule = "same-rule-differs";
  }
  said.add(f);
  if (data.touched() && said.scene.window < said.scene.duration && b.centres)
    said.add({.rule = "centres", .method = ours, .other = b.method, .value = *b.centres});
}

void agreement(Said& said) {
  for (const MethodData& b : said.data.methods)
    if (b.ok() && b.difference && is_another_engine(b.method) && stands_for_its_engine(b.method) &&
        b.method != position_based(family_of(b.method)))
      agreement_with(b, said);
}

/// "3 mm", or "less than 3 nm" where the truth is known no better.
std::string off_text(const MethodData& m, const SceneData& data) {
  return (*m.error < data.error_bar ? "less than " : "") + nice_length(std::max(*m.error, data.error_bar));
}

Finding error_of(const MethodData& m, const std::string& rule, const SceneData& data) {
  return {.rule = rule,
          .method = m.method,
          .value = std::max(*m.error, data.error_bar),
          .low = std::max(0., *m.error - data.error_bar),
          .high = *m.error + data.error_bar,
          .tier = data.tier,
          .words = {{"off", off_text(m, data)}}};
}

/// Of those that are as near as the nearest (ties_with()) the thriftiest; their number in `tied`.
const MethodData* nearest(const std::vector<const MethodData*>& among, const SceneData& data, size_t& tied) {
  if (among.empty()) return nullptr;
  const MethodData* best = *std::ranges::min_element(among, {}, [](const MethodData* m) { return *m->error; });
  const MethodData* thriftiest = nullptr;
  tied = 0;
  for (const MethodData* m : among)
    if (ties_with(*m, *best, data)) {
      ++tied;
      if (!thriftiest || m->evaluations < thriftiest->evaluations) thriftiest = m;
    }
  return thriftiest;
}

void accuracy(Said& said) {
  const SceneData& data = said.data;
  std::vector<const MethodData*> judged, single;
  for (const MethodData& m : data.methods) {
    if (m.judged()) judged.push_back(&m);
    if (m.judged() && m.single_evaluation(said.scene)) single.push_back(&m);
  }
  size_t tied = 0;
  const MethodData* best = nearest(judged, data, tied);
  if (!best || !(data.motion > 0)) return;
  Finding f = error_of(*best, "nearest", data);
  f.words["window"] = step_text(std::min(said.scene.window, data.truth_until.value_or(said.scene.window)));
  f.words["others"] = tied == 1 ? "" : fmt::format(", with {} as near", counted(tied - 1, "other"));
  said.add(f);
  if (const MethodData* of_single = nearest(single, data, tied); of_single && !ties_with(*of_single, *best, data))
    said.add(error_of(*of_single, "nearest-single", data));
  // the other engines
  std::vector<std::string> engines{engine_of(best->method)};
  for (const MethodData* each : judged) {
    const std::string engine = engine_of(each->method);
    if (std::ranges::find(engines, engine) != engines.end()) continue;
    engines.push_back(engine);
    std::vector<const MethodData*> its = judged;
    std::erase_if(its, [&](const MethodData* m) { return engine_of(m->method) != engine; });
    const MethodData* m = nearest(its, data, tied);
    Finding of_engine = error_of(*m, "nearest-of-engine", data);
    of_engine.other = engine;
    of_engine.words["share"] = said.share(of_engine.value);
    of_engine.words["best"] = its.size() == 1 ? "" : ", the nearest of " + name_in_sentence(engine);
    said.add(of_engine);
  }
}

/// The known cause. It damps as implicit Euler does, and where it errs no more its law is not what is seen.
std::string why_off(const Said& said, const MethodData& p, const Method& method) {
  const MethodData* implicit = said.data.find(subject_method(is_implicit));
  // 1.3: far below the factors of 3 and more between the scenes where laws differ and where they do not
  if (p.error && implicit && implicit->ok() && implicit->error && *p.error < 1.3 * *implicit->error)
    return "about as far as implicit Euler at the same step";
  if (said.scene.model.find<Constraints>()) return "it solves hard lengths one after the other";
  const auto* springs = said.scene.model.find<Springs>();
  const std::string several = springs->list.size() > 1 ? " and are solved one by one" : "";
  return (springs->law == method.spring_law ? "its springs follow the scene's law" : "its springs follow another law") +
         several;
}

void other_law(Said& said) {
  const SceneData& data = said.data;
  for (const MethodFamily* peer : default_peers()) {
    const Method* method = builtin_method(position_based(*peer));
    const MethodData* p = method ? data.find(method->name) : nullptr;
    if (!p || !p->ok() || !said.scene.model.find<Springs>() || !(data.motion > 0)) continue;
    const std::string why = why_off(said, *p, *method);
    if (p->error)
      said.add({.rule = "other-law",
                .method = p->method,
                .value = 100 * *p->error / data.motion,
                .low = 100 * std::max(0., *p->error - data.error_bar) / data.motion,
                .high = 100 * (*p->error + data.error_bar) / data.motion,
                .tier = data.tier,
                .words = {{"off", nice_length(*p->error)}, {"why", why}}});
    else if (p->difference)
      said.add({.rule = "other-law-difference",
                .method = p->method,
                .other = ours,
                .value = *p->difference,
                .words = {{"window", said.window()}, {"why", why}}});
  }
}

void failures(Said& said) {
  size_t all = 0, failed = 0;
  const MethodData* first = nullptr;
  for (const MethodData& m : said.data.methods) {
    all += m.supported();
    if (!m.supported() || m.ok()) continue;
    ++failed;
    if (!first || m.end < first->end) first = &m;
  }
  if (!first) return;
  const std::string limit = !first->limit || *first->limit >= first->step ? ""
                            : *first->limit > 0 ? fmt::format(" (stable up to {})", step_text(*first->limit))
                                                : " (stable at no step)";
  said.add({.rule = "failed",
            .method = first->method,
            .value = static_cast<double>(failed),
            .words = {{"step", step_text(first->step)},
                      {"methods", counted(all, "method")},
                      {"end", step_text(first->end)},
                      {"first", failed == 1 ? ":" : ", first"},
                      {"limit", limit}}});
}

/// The deepest of all runs; the table of runs has the others.
void contact(Said& said) {
  const MethodData* deepest = nullptr;
  for (const MethodData& m : said.data.methods)
    if (m.ok() && m.clearance && (!deepest || *m.clearance < *deepest->clearance)) deepest = &m;
  if (said.data.touched() && deepest && *deepest->clearance < -1e-12)
    said.add({.rule = "sinks-in", .method = deepest->method, .value = -*deepest->clearance});
}

/// Differences from the converged in-house contact rule: no errors, as other rules converge to something else.
void converged_contact(Said& said) {
  if (!said.data.contact_until) return;
  const std::string of_second_order = subject_method(is_symplectic_of_second_order);
  for (const MethodData& m : said.data.methods)
    if (m.ok() && m.from_contact && (m.method == of_second_order || stands_for_its_engine(m.method)) &&
        m.method != position_based(family_of(m.method)))
      said.add({.rule = "converged-contact",
                .method = m.method,
                .value = *m.from_contact,
                .low = std::max(0., *m.from_contact - said.data.error_bar),
                .high = *m.from_contact + said.data.error_bar,
                .words = {{"window", step_text(*said.data.contact_until)}}});
}

void sticky(Said& said) {
  const MethodData* m = said.data.find(sticky_sphere);
  if (m && m->ok() && m->centres && said.data.touched() && *m->centres >= 10 * said.scene.tolerance)
    said.add({.rule = "sticky", .method = m->method, .other = ours, .value = *m->centres});
}

}  // namespace

std::vector<Finding> findings_of(const Scene& scene, const SceneData& data, const TableSet& rows) {
  Said said{scene, data};
  for (const auto part : {agreement, accuracy, other_law, failures, contact, converged_contact, sticky}) part(said);
  for (Finding& f : recommendation_findings(scene, rows)) said.out.push_back(std::move(f));
  return std::move(said.out);
}

}  // namespace crosscheck
