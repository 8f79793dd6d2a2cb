// `check`: checks the relations of methods, and which violations are expected.
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
  std::string method, relation, scene;  // globs; empty scene: all scenes
  std::string reason;                   // one sentence with the measured cause
  std::optional<double> times;          // largest expected ratio to the tolerance; empty: any
  std::string rule = {};                // glob on rule_of(method), in place of `method`
};
std::filesystem::path shipped_known_breaks();
/// Reads [[known]] tables: relation, reason, method or rule; optionally scene and times. Throws InputError.
std::vector<KnownBreak> read_known_breaks(const std::filesystem::path& file);

struct Answer {
  std::string method, scene;
  const Relation* relation;
  RelationMark mark = RelationMark::holds;
  RelationResult finding;  // valid if the relation is applicable
  std::string reason;      // why it is not applicable, how a run failed, or why the violation is known
  std::string scene_hash;
  Verdict failure = Verdict::ok;

  /// "0.02 of the tolerance of 1e-12 m", "35 times the tolerance of 2e-3 J since 0.4 s", or the reason.
  std::string sentence() const;
};

/// Marks a violation as known if the list contains it. `rule`: rule of the method, empty for a pair.
void mark_known(Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule = "");

Answer ask(const Relation& relation, Subject& subject, const Scene& scene, unsigned seed,
           const std::vector<KnownBreak>& known);

/// Receives the name of the next check, such as "mysim/leapfrog: turned".
using AboutToAsk = std::function<void(const std::string&)>;

using OnAnswer = std::function<void(const Answer&)>;

/// Checks every relation of a method, or `only` one, on the given scenes to which it applies or, without scenes, on its
/// smallest ones. If every run of the method crashed, its relations count as not applicable.
std::vector<Answer> answers_of(const Method& method, const std::vector<Scene>& scenes, unsigned seed,
                               const std::vector<KnownBreak>& known, const AboutToAsk& begin = {},
                               const OnAnswer& on_answer = {}, const Relation* only = nullptr);

/// 0 if at least one relation was applicable and only known violations were found; else 1.
int status_of(const std::vector<Answer>& answers);

Table table_of(const std::vector<Answer>& answers);

}  // namespace crosscheck
