// `check`: relations asked of methods, and which broken ones are known.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/check/relations.h"
#include "experiments/tables/check.h"

namespace crosscheck {

/// A relation that a method breaks by design, or by a cause that was measured.
struct KnownBreak {
  std::string method, relation, scene;  // globs; no scene: all
  std::string reason;                   // one sentence with the cause as measured
  std::optional<double> times;          // up to so many times the tolerance; none: whatever the size
  std::string rule = {};                // glob of the rule that the method follows (rule_of); no `method` is given then
};
/// Where those that come with Crosscheck stand.
std::filesystem::path shipped_known_breaks();
/// [[known]] tables with method or rule, relation, reason, scene where it is one alone, and times. Throws InputError.
std::vector<KnownBreak> read_known_breaks(const std::filesystem::path& file);

/// One relation asked of one method on one scene.
struct Answer {
  std::string method, scene;
  const Relation* relation;
  RelationMark mark = RelationMark::holds;
  RelationResult finding;  // where it could be asked
  std::string reason;      // why not; how a run failed; why it is known
  std::string scene_hash;
  Verdict failure = Verdict::ok;  // of a run that failed

  /// "0.02 of the tolerance of 1e-12 m", "35 times the tolerance of 2e-3 J since 0.4 s", or the reason.
  std::string sentence() const;
};

/// A broken one becomes known where a row of the list covers it; `rule`: that of the method, empty for a pair.
void mark_known(Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule = "");

Answer ask(const Relation& relation, Subject& subject, const Scene& scene, unsigned seed,
           const std::vector<KnownBreak>& known);

/// Is told what is asked next, "mysim/leapfrog: turned".
using AboutToAsk = std::function<void(const std::string&)>;

/// Is shown each answer as it comes.
using OnAnswer = std::function<void(const Answer&)>;

/// Every relation of a method, or the one given: on its smallest scenes where no scene is given, else on each of these
/// that it says something about. A method that ended no run could not be asked.
std::vector<Answer> answers_of(const Method& method, const std::vector<Scene>& scenes, unsigned seed,
                               const std::vector<KnownBreak>& known, const AboutToAsk& begin = {},
                               const OnAnswer& on_answer = {}, const Relation* only = nullptr);

/// 0 where something was asked and nothing but known breaks was found; else 1.
int status_of(const std::vector<Answer>& answers);

Table table_of(const std::vector<Answer>& answers);

}  // namespace crosscheck
