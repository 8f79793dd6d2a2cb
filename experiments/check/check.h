// `check`: tests metamorphic relations of methods, and marks expected violations.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/check/relations.h"
#include "experiments/tables/check.h"

namespace crosscheck {

/// A relation that a method violates by design, or for a measured cause.
struct KnownBreak {
  std::string method, relation, scene;  // globs; an empty `scene` matches all scenes
  std::string reason;                   // one sentence with the measured cause
  std::optional<double> times;          // largest expected ratio of the violation to the tolerance; nullopt: any
  std::string rule = {};                // glob on rule_of(method), in place of `method`
};
std::filesystem::path shipped_known_breaks();
/// Reads [[known]] tables with the keys relation, reason, and method or rule; optionally also scene and times. Throws
/// InputError.
std::vector<KnownBreak> read_known_breaks(const std::filesystem::path& file);

struct Answer {
  std::string method, scene;
  const Relation* relation;
  RelationMark mark = RelationMark::holds;
  RelationResult finding;  // valid if the relation is applicable
  std::string reason;      // reason why the relation does not apply, a run failed, or the violation is known
  std::string scene_hash;
  Verdict failure = Verdict::ok;

  /// Examples: "0.02 of the tolerance of 1e-12 m", "35 times the tolerance of 2e-3 J since 0.4 s"; or the reason.
  std::string sentence() const;
};

/// Marks a violation as known if the list contains it. `rule`: the method's rule; empty for a pair of methods.
void mark_known(Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule = "");

Answer ask(const Relation& relation, Subject& subject, const Scene& scene, unsigned seed,
           const std::vector<KnownBreak>& known);

/// Receives the name of the next check, such as "mysim/leapfrog: turned".
using AboutToAsk = std::function<void(const std::string&)>;

using OnAnswer = std::function<void(const Answer&)>;

/// Checks every relation of a method (or just the relation `only`) on the given scenes to which it applies, or on its
/// own smallest scenes if none are given. If every run of the method crashed, all relations count as not applicable.
std::vector<Answer> answers_of(const Method& method, const std::vector<Scene>& scenes, unsigned seed,
                               const std::vector<KnownBreak>& known, const AboutToAsk& begin = {},
                               const OnAnswer& on_answer = {}, const Relation* only = nullptr);

/// Exit status: 0 if at least one relation was applicable and all violations found were known; otherwise 1.
int status_of(const std::vector<Answer>& answers);

Table table_of(const std::vector<Answer>& answers);

}  // namespace crosscheck
