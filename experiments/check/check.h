// `check`: checks relations of methods, and knows which breaks are expected.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/check/relations.h"
#include "experiments/tables/check.h"

namespace crosscheck {

/// A relation that a method breaks by design, or for a measured cause.
struct KnownBreak {
  std::string method, relation, scene;  // globs; empty scene: all scenes
  std::string reason;                   // one sentence with the measured cause
  std::optional<double> times;          // largest expected ratio to the tolerance; none: any size
  std::string rule = {};                // glob of the rule that the method follows (rule_of), in place of `method`
};
/// The list that is shipped with Crosscheck.
std::filesystem::path shipped_known_breaks();
/// Reads [[known]] tables with method or rule, relation, reason, and optionally scene and times. Throws InputError.
std::vector<KnownBreak> read_known_breaks(const std::filesystem::path& file);

/// Result of one relation for one method on one scene.
struct Answer {
  std::string method, scene;
  const Relation* relation;
  RelationMark mark = RelationMark::holds;
  RelationResult finding;  // if the relation is applicable
  std::string reason;      // why it is not applicable, how a run failed, or why the break is known
  std::string scene_hash;
  Verdict failure = Verdict::ok;  // verdict of a failed run

  /// "0.02 of the tolerance of 1e-12 m", "35 times the tolerance of 2e-3 J since 0.4 s", or the reason.
  std::string sentence() const;
};

/// Marks a broken relation as known if an entry of the list covers it. `rule`: rule of the method, empty for a pair.
void mark_known(Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule = "");

Answer ask(const Relation& relation, Subject& subject, const Scene& scene, unsigned seed,
           const std::vector<KnownBreak>& known);

/// Receives the name of the next check: "mysim/leapfrog: turned".
using AboutToAsk = std::function<void(const std::string&)>;

/// Receives each answer when it is complete.
using OnAnswer = std::function<void(const Answer&)>;

/// Checks every relation of a method, or only the given one: on the relation's smallest scenes if `scenes` is empty,
/// else on each of these scenes that it applies to. If no run of the method ended (crashes), its
/// relations count as not applicable.
std::vector<Answer> answers_of(const Method& method, const std::vector<Scene>& scenes, unsigned seed,
                               const std::vector<KnownBreak>& known, const AboutToAsk& begin = {},
                               const OnAnswer& on_answer = {}, const Relation* only = nullptr);

/// 0 if at least one relation was applicable and only known breaks were found; else 1.
int status_of(const std::vector<Answer>& answers);

Table table_of(const std::vector<Answer>& answers);

}  // namespace crosscheck
