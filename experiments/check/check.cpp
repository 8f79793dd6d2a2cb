#include "experiments/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/check/transformations.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/pattern.h"
#include "mysim/scene/toml.h"

namespace crosscheck {
namespace {

const KnownBreak* known_break(const Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule) {
  for (const KnownBreak& one : known)
    if ((one.rule.empty() ? glob_matches(one.method, answer.method) : glob_matches(one.rule, rule)) &&
        glob_matches(one.relation, std::string(answer.relation->name)) &&
        (one.scene.empty() || glob_matches(one.scene, answer.scene)) &&
        (!one.times || (!answer.finding.what.empty() && answer.finding.ratio() <= *one.times)))
      return &one;
  return nullptr;
}

/// Crashed runs show nothing about the mechanics of a program.
void withdraw_where_nothing_ran(std::vector<Answer>& answers) {
  const auto says_nothing = [](const Answer& a) {
    return a.mark == RelationMark::not_applicable || a.failure == Verdict::crash;
  };
  if (!std::ranges::all_of(answers, says_nothing)) return;
  for (Answer& a : answers) a.mark = RelationMark::not_applicable;
}

}  // namespace

std::filesystem::path shipped_known_breaks() { return data_folder() / "experiments/check/known.toml"; }

std::vector<KnownBreak> read_known_breaks(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::parse_text(read_file(file, "a table of known breaks"), file.string());
  std::vector<KnownBreak> list;
  for (const TomlTable& s : root.sections("known")) {
    KnownBreak one{s.has("rule") ? "" : s.text("method"),
                   s.text("relation"),
                   s.has("scene") ? s.text("scene") : "",
                   s.text("reason"),
                   {}};
    if (s.has("rule")) one.rule = s.text("rule");
    if (s.has("times")) one.times = s.positive("times");
    if (std::none_of(relations().begin(), relations().end(),
                     [&](const Relation& r) { return glob_matches(one.relation, std::string(r.name)); }))
      s.fail("relation", "the name of a relation, got '" + one.relation + "'");
    list.push_back(std::move(one));
  }
  root.finish();
  return list;
}

std::string Answer::sentence() const {
  if (mark == RelationMark::not_applicable || finding.what.empty()) return reason;
  const std::string unit = finding.unit == "1" ? "" : " " + finding.unit;
  const std::string allowed = fmt::format("the tolerance of {:.2g}{}", finding.tolerance, unit);
  std::string text = finding.tolerance <= 0 ? fmt::format("{:.2g}{}, where only 0 is allowed", finding.measured, unit)
                     : finding.holds()      ? fmt::format("{:.2g} of {}", finding.ratio(), allowed)
                                            : fmt::format("{:.3g} times {}", finding.ratio(), allowed);
  if (finding.since) text += fmt::format(", since {:.3g} s", *finding.since);
  if (!finding.holds()) text += ": " + finding.what;
  return mark == RelationMark::known ? text + "; known: " + reason : text;
}

void mark_known(Answer& answer, const std::vector<KnownBreak>& known, const std::string& rule) {
  if (answer.mark != RelationMark::broken) return;
  const KnownBreak* one = known_break(answer, known, rule);
  if (!one) return;
  answer.mark = RelationMark::known;
  answer.reason += (answer.reason.empty() ? "" : "; known: ") + one->reason;
}

Answer ask(const Relation& relation, Subject& subject, const Scene& scene, unsigned seed,
           const std::vector<KnownBreak>& known) {
  Answer answer{subject.method().name, scene.name, &relation, RelationMark::holds, {}, "", hash_of(scene)};
  try {
    answer.finding = relation.ask(subject, scene, seed);
    if (!answer.finding.holds()) answer.mark = RelationMark::broken;
  } catch (const CannotBeAsked& why) {
    answer.mark = RelationMark::not_applicable, answer.reason = why.what();
  } catch (const RunFailed& how) {
    answer.mark = RelationMark::broken, answer.reason = how.what();
    answer.finding.since = how.end, answer.failure = how.verdict;
  }
  mark_known(answer, known, answer.mark == RelationMark::broken ? rule_of(subject.method()) : "");
  return answer;
}

std::vector<Answer> answers_of(const Method& method, const std::vector<Scene>& scenes, unsigned seed,
                               const std::vector<KnownBreak>& known, const AboutToAsk& begin, const OnAnswer& on_answer,
                               const Relation* only) {
  std::vector<Answer> answers;
  Subject subject(method);
  for (const Relation& relation : only ? std::span(only, 1) : relations()) {
    if (begin) begin(fmt::format("{}: {}", method.name, relation.name));
    for (const Scene& scene : scenes.empty() ? relation.smallest() : scenes)
      if (scenes.empty() || relation.excluded(scene).empty()) {
        answers.push_back(ask(relation, subject, scene, seed, known));
        if (on_answer) on_answer(answers.back());
      }
  }
  withdraw_where_nothing_ran(answers);
  return answers;
}

int status_of(const std::vector<Answer>& answers) {
  const auto any = [&](RelationMark mark) {
    return std::any_of(answers.begin(), answers.end(), [&](const Answer& a) { return a.mark == mark; });
  };
  return !any(RelationMark::broken) && (any(RelationMark::holds) || any(RelationMark::known)) ? 0 : 1;
}

Table table_of(const std::vector<Answer>& answers) {
  Table table = table_of<RelationRow>();
  for (const Answer& a : answers) {
    RelationRow row{a.method,
                    std::string(a.relation->name),
                    a.scene,
                    a.mark,
                    a.finding.what,
                    a.finding.unit,
                    {},
                    {},
                    {},
                    {},
                    a.reason,
                    a.scene_hash};
    row.since = a.finding.since;
    if (!a.finding.what.empty()) {
      row.measured = a.finding.measured, row.tolerance = a.finding.tolerance;
      if (std::isfinite(a.finding.ratio())) row.ratio = a.finding.ratio();
    }
    add(table, row);
  }
  return table;
}

}  // namespace crosscheck
